// SPDX-License-Identifier: Apache-2.0
#include "eval/four_face_levels.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <utility>

#include "limber/base/portable_math.h"
#include "limber/base/triangles.h"
#include "limber/clip/frame_files.h"
#include "limber/clip/input_file.h"

namespace limber::eval {
namespace {

Error located(const std::string& name, const Error& error) {
  return {error.code, error.where.empty() ? name : name + ": " + error.where, error.what};
}

class FourFaceMeshes final : public MeshSource {
 public:
  FourFaceMeshes(std::unique_ptr<FourFaceLevels> levels, const FourFaceRequest& request, const ClipOptions& options)
      : levels_(std::move(levels)), request_(request), step_(options.step) {
    const std::uint32_t low = levels_->first_frame_number();
    next_ = first_ = options.first.value_or(low) - low;
    end_ = options.last ? *options.last - low + 1 : levels_->available_frames();
  }

  std::optional<std::uint32_t> frame_count() const override { return (end_ - first_ + step_ - 1) / step_; }
  std::uint32_t first_frame_number() const override { return levels_->first_frame_number() + first_; }

  Result<bool> read(SourceMesh& mesh) override {
    if (next_ >= end_) return false;
    if (const Result<void> there = levels_->go_to(next_, request_); !there) return there.error();
    mesh = levels_->mesh();
    next_ += step_;
    return true;
  }

 private:
  std::unique_ptr<FourFaceLevels> levels_;
  FourFaceRequest request_;
  std::uint32_t step_, first_ = 0, next_ = 0, end_ = 0;
};

}  // namespace

bool is_four_face_file(const std::filesystem::path& path) {
  std::array<char, kPreambleSize + 4> first{};
  std::ifstream file(path, std::ios::binary);
  file.read(first.data(), first.size());
  return limber::is_four_face_file(std::as_bytes(std::span(first)).first(static_cast<std::size_t>(file.gcount())));
}

FrontRequest front_request(const FourFaceRequest& request, double diagonal) {
  FrontRequest wanted = request.front;
  if (request.error_percent) wanted.error = *request.error_percent / 100 * diagonal;
  if (request.bend_degrees) wanted.bend = 1 - portable_cos(*request.bend_degrees * (kPi / 180));
  return wanted;
}

Result<std::unique_ptr<FourFaceLevels>> FourFaceLevels::open(const std::filesystem::path& path) {
  std::unique_ptr<FourFaceLevels> levels(new FourFaceLevels(path.string()));
  if (const Result<void> read = read_file(path, levels->bytes_); !read) return read.error();
  const Result<void> opened = levels->clip_.open(std::as_bytes(std::span(levels->bytes_)));
  if (!opened) return located(levels->name_, opened.error());
  if (levels->clip_.decoder().header().part_count > 1) {
    return Error{ErrorCode::kUnsupported, levels->name_,
                 "has several parts, of a mesh larger than memory; extract a mesh out of it first"};
  }
  levels->front_.emplace(levels->clip_.mesh());
  return levels;
}

Result<void> FourFaceLevels::go_to(std::uint32_t frame, const FourFaceRequest& request) {
  if (const Result<void> gone = clip_.go_to(frame); !gone) return located(name_, gone.error());
  const FourKMesh& structure = clip_.mesh();
  const FrontRequest wanted = front_request(request, clip_.decoder().header().diagonal);
  std::vector<float> bend;
  if (wanted.bend) bend = bends(structure, clip_.positions());
  move_front(*front_, structure, clip_.positions(), wanted, bend, request.hysteresis);
  std::vector<Index> alive(front_->triangles().begin(), front_->triangles().end());
  std::ranges::sort(alive);
  mesh_.triangles.clear();
  for (const Index t : alive) mesh_.triangles.push_back(structure.triangles[t]);
  renumber(mesh_.triangles, structure.vertex_count, vertices_, place_);
  mesh_.positions.clear(), mesh_.nodes.clear();
  for (const Index v : vertices_) {
    mesh_.positions.push_back(clip_.positions()[v]);
    mesh_.nodes.push_back(clip_.numbers()[v]);
  }
  return {};
}

double FourFaceLevels::error() const {
  const FourKMesh& structure = clip_.mesh();
  float largest = 0;
  for (const Index t : front_->triangles())
    if (structure.creator[t] != kNone) largest = std::max(largest, structure.error[structure.creator[t]]);
  const double diagonal = clip_.decoder().header().diagonal;
  return diagonal > 0 ? 100 * static_cast<double>(largest) / diagonal : 0;
}

Result<std::unique_ptr<MeshSource>> open_four_face_meshes(std::string_view path, const FourFaceRequest& request,
                                                          const ClipOptions& options) {
  auto levels = FourFaceLevels::open(path);
  if (!levels) return levels.error();
  const std::uint32_t low = (*levels)->first_frame_number();
  const std::uint64_t high = std::uint64_t{low} + (*levels)->available_frames() - 1;
  if (const Result<void> fits = check_range(options, low, high, std::string(path)); !fits) return fits.error();
  return std::unique_ptr<MeshSource>(std::make_unique<FourFaceMeshes>(std::move(*levels), request, options));
}

}  // namespace limber::eval

// SPDX-License-Identifier: Apache-2.0
// Levels of detail out of a four-face file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "eval/mesh_source.h"
#include "limber/base/result.h"
#include "limber/fourface/front.h"
#include "limber/fourface/front_request.h"
#include "limber/stream/four_k_clip.h"

namespace limber::eval {

// Whether there is such a file, by its first bytes; false where it cannot be read.
bool is_four_face_file(const std::filesystem::path& path);

// A request with lengths as a user gives them.
struct FourFaceRequest {
  FrontRequest front;                   // its error and bend are those below
  std::optional<double> error_percent;  // of the diagonal of the first frame's bounding box
  std::optional<double> bend_degrees;   // 0 to 180
  double hysteresis = 1;                // as of move_front()
};

// What the request asks of a front of a file whose first frame has this diagonal.
FrontRequest front_request(const FourFaceRequest& request, double diagonal);

class FourFaceLevels {
 public:
  // Reads the file. Errors name it.
  static Result<std::unique_ptr<FourFaceLevels>> open(const std::filesystem::path& path);

  const FourKClip& clip() const { return clip_; }
  std::uint32_t first_frame_number() const { return clip_.decoder().header().first_frame_number; }
  std::uint32_t available_frames() const { return clip_.decoder().frame_count(); }
  // Nothing where the finest operations have not arrived.
  bool is_whole() const { return clip_.is_whole() && clip_.decoder().is_whole(); }

  // Makes the front of a frame, counted from 0. Precondition: frame < available_frames(). With hysteresis it depends on
  // the frame gone to before.
  Result<void> go_to(std::uint32_t frame, const FourFaceRequest& request);

  // Preconditions of all that follow: go_to() succeeded. Only vertices that triangles use; nodes are numbers of the
  // input's vertices.
  const SourceMesh& mesh() const { return mesh_; }
  // The largest error of an operation that is applied, in percent of the diagonal.
  double error() const;
  Index changes() const { return front_->changes(); }

 private:
  explicit FourFaceLevels(std::string name) : name_(std::move(name)) {}

  std::string name_;
  std::string bytes_;
  FourKClip clip_;
  std::optional<Front> front_;
  std::vector<Index> vertices_, place_;
  SourceMesh mesh_;
};

// A front of every frame between options.first and options.last, each with the request.
Result<std::unique_ptr<MeshSource>> open_four_face_meshes(std::string_view path, const FourFaceRequest& request,
                                                          const ClipOptions& options);

}  // namespace limber::eval

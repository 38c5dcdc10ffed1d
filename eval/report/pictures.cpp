// SPDX-License-Identifier: Apache-2.0
#include "eval/report/pictures.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "eval/png.h"
#include "eval/report/words.h"
#include "eval/sheet.h"
#include "eval/text.h"
#include "limber/base/portable_math.h"

namespace limber::eval {
namespace {

// With twice as many pictures each is smaller, so that the page stays within its ten megabytes.
constexpr double kAllPixels = 6.5e6;
constexpr double kAspect = 1.25;
constexpr double kWireWidth = 1.3;       // the page shows pictures at about half their size
constexpr double kCloseUpRadius = 0.07;  // of the diagonal: half the height of the picture

int picture_width(std::size_t picture_count) {
  const double area = kAllPixels / static_cast<double>(std::max<std::size_t>(picture_count, 1));
  return static_cast<int>(std::clamp(std::sqrt(area * kAspect), 240.0, 440.0));
}

Result<std::string> png_text(const Image& image) {
  const Result<std::vector<std::byte>> bytes = encode_png(image);
  if (!bytes) return bytes.error();
  return base64(*bytes);
}

Vec3d up_vector(UpAxis up) { return up == UpAxis::kY ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1}; }

// Nearer than the box around the surface allows: small pictures need all of their room.
Camera fitted_camera(const Surface& surface, const PictureOptions& options) {
  constexpr int kRound = 3;  // turning the camera towards the middle moves the outline a little
  constexpr double kFilled = 0.94;
  const Box box = bounding_box(surface);
  Camera camera = frame_camera(box, direction_to_eye(options.view, options.up), kAspect, {.up = up_vector(options.up)});
  for (int round = 0; round < kRound; ++round) {
    const Projection projection(camera, options.width, options.height);
    double low_x = options.width, high_x = 0, low_y = options.height, high_y = 0;
    for (const Triangle& triangle : surface.triangles) {
      for (const Index vertex : triangle) {
        const ScreenPoint p = projection.project(Vec3d(surface.positions[vertex]));
        if (!(p.w > 0)) continue;
        low_x = std::min(low_x, p.x / p.w), high_x = std::max(high_x, p.x / p.w);
        low_y = std::min(low_y, p.y / p.w), high_y = std::max(high_y, p.y / p.w);
      }
    }
    const double used = std::max((high_x - low_x) / options.width, (high_y - low_y) / options.height);
    if (!(used > 0.01)) return camera;
    const Vec3d middle = projection.ray((low_x + high_x) / 2, (low_y + high_y) / 2);
    camera.target = camera.eye + middle * length(camera.target - camera.eye);
    const double half = std::tan(camera.fov_degrees * kPi / 360) * used / kFilled;
    camera.fov_degrees = std::min(std::atan(half) * 360 / kPi, 60.0);
  }
  return camera;
}

// Without what stands between the eye and the place.
std::vector<Triangle> behind(const Surface& surface, const Vec3d& point, const Vec3d& to_eye, double distance) {
  std::vector<Triangle> kept;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (dot(corner(surface, t, k) - point, to_eye) > distance) continue;
      kept.push_back(surface.triangles[t]);
      break;
    }
  }
  return kept;
}

// Without the empty margins that all of them have, on white.
void crop(std::vector<SheetTile>& tiles) {
  const Image& first = tiles.front().image;
  int left = first.width, right = 0, top = first.height, bottom = 0;
  for (const SheetTile& tile : tiles) {
    for (int y = 0; y < first.height; ++y) {
      for (int x = 0; x < first.width; ++x) {
        if (tile.image.at(x, y).a == 0) continue;
        left = std::min(left, x), right = std::max(right, x + 1);
        top = std::min(top, y), bottom = std::max(bottom, y + 1);
      }
    }
  }
  if (right <= left) left = 0, right = first.width, top = 0, bottom = first.height;
  for (SheetTile& tile : tiles) {
    Image cropped(right - left, bottom - top, kWhite);
    for (int y = top; y < bottom; ++y) {
      for (int x = left; x < right; ++x) blend(cropped.at(x - left, y - top), tile.image.at(x, y), 1);
    }
    tile.image = std::move(cropped);
  }
}

// Where a close-up is taken from.
struct Stand {
  Vec3d target{};
  Vec3d to_eye{};     // unit
  double radius = 0;  // half the height of the picture, at the target
};

// Takes the pictures of a row, the original's first.
struct Studio {
  const Mesh& mesh;
  PictureOptions options;
  std::vector<std::string> sheet_labels;
  std::size_t taken = 0, all = 0;
  const std::function<bool(std::size_t, std::size_t)>& done;
  std::vector<SheetTile> tiles{};  // of the row that is being made

  Result<void> add(PictureRow& row, const Image& image) {
    Result<std::string> text = png_text(image);
    if (!text) return text.error();
    row.pictures.push_back(std::move(*text));
    if (!sheet_labels.empty()) tiles.push_back({image, sheet_labels[tiles.size()]});
    if (!done(++taken, all)) return Error{ErrorCode::kCancelled, "", "stopped"};
    return {};
  }

  Result<PictureRow> finished(PictureRow row) {
    if (tiles.empty()) return row;
    crop(tiles);
    Result<std::vector<std::byte>> sheet = encode_png(
        contact_sheet(tiles, {.columns = static_cast<int>(tiles.size() <= 6 ? tiles.size() : (tiles.size() + 1) / 2),
                              .gap = 12,
                              .text_height = 0.034 * options.width}));
    tiles.clear();
    if (!sheet) return sheet.error();
    row.sheet = std::move(*sheet);
    return row;
  }

  PictureRow empty_row(const KeptFrame& kept) const {
    return {.frame = kept.frame, .width = options.width, .height = options.height, .pictures = {}, .sheet = {}};
  }

  PictureOptions plain() const {
    PictureOptions changed = options;
    changed.error_colors = changed.wireframe = false;
    changed.shading = Shading::kSmooth;
    return changed;
  }

  Result<PictureRow> whole(const KeptFrame& kept) {
    PictureRow row = empty_row(kept);
    const Surface original{mesh.triangles, kept.original};
    const Camera camera = fitted_camera(original, options);
    if (Result<void> added = add(row, Photographer(plain(), camera).take(original, {})); !added) return added.error();
    Photographer photographer(options, camera);
    for (const KeptFrame::Made& made : kept.made) {
      if (Result<void> added = add(row, photographer.take(made, original)); !added) return added.error();
    }
    return finished(std::move(row));
  }

  Result<PictureRow> close(const KeptFrame& kept, const Stand& stand) {
    PictureRow row = empty_row(kept);
    const Surface original{mesh.triangles, kept.original};
    Camera camera;
    camera.target = stand.target;
    camera.up = up_vector(options.up);
    camera.eye = stand.target + stand.to_eye * (stand.radius / 0.21256);  // the tangent of half the field of view
    const std::vector<Triangle> shown = behind(original, stand.target, stand.to_eye, 1.5 * stand.radius);
    const Image image = Photographer(plain(), camera).take({shown, original.positions}, {});
    if (Result<void> added = add(row, image); !added) return added.error();
    Photographer photographer(options, camera);
    for (const KeptFrame::Made& made : kept.made) {
      const std::vector<Triangle> visible = behind(made, stand.target, stand.to_eye, 1.5 * stand.radius);
      const Image shot = visible.empty() ? Image(options.width, options.height, options.background)
                                         : photographer.take({visible, made.positions}, original);
      if (Result<void> added = add(row, shot); !added) return added.error();
    }
    return finished(std::move(row));
  }

  Result<PictureRow> worst(const KeptFrame& kept, const WorstPlace& place) {
    Vec3d to_eye = place.normal + direction_to_eye(options.view, options.up) * 0.3;
    if (!(length(to_eye) > 0.1)) to_eye = direction_to_eye(options.view, options.up);
    const double diagonal = bounding_box({mesh.triangles, kept.original}).diagonal();
    return close(kept, {place.point, to_eye * (1 / length(to_eye)), kCloseUpRadius * diagonal});
  }

  Result<PictureRow> part(const KeptFrame& kept, std::span<const Index> triangles) {
    const Surface original{mesh.triangles, kept.original};
    Box box;
    for (const Index t : triangles) {
      for (std::size_t k = 0; k < 3; ++k) box.add(corner(original, t, k));
    }
    const Vec3d middle = (box.low + box.high) * 0.5;
    return close(kept, {middle, direction_to_eye(options.view, options.up), 0.5 * box.diagonal()});
  }
};

}  // namespace

std::vector<std::size_t> chosen_places(const WorstPlaces& places, std::size_t method_count, std::size_t count) {
  std::vector<std::size_t> ranked;
  for (std::size_t method = 0; method < method_count; ++method) {
    if (method != 0 || method_count == 1) ranked.push_back(method);
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [&](std::size_t a, std::size_t b) { return places.of(a).loss > places.of(b).loss; });
  std::vector<std::size_t> apart;
  for (const std::size_t method : ranked) {
    const auto same = [&](std::size_t other) {
      return places.of(other).frame == places.of(method).frame && places.of(other).rms == places.of(method).rms;
    };
    if (std::none_of(apart.begin(), apart.end(), same)) apart.push_back(method);
  }
  if (apart.size() <= count) return apart;
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < count; ++k)
    chosen.push_back(apart[k * (apart.size() - 1) / std::max<std::size_t>(count - 1, 1)]);
  return chosen;
}

Result<PictureSet> take_report_pictures(const Mesh& mesh, const KeptFrames& kept, const WorstPlaces& places,
                                        std::span<const std::size_t> shown, const PictureSetOptions& options,
                                        const std::function<bool(std::size_t, std::size_t)>& done) {
  const std::vector<KeptFrames::Kept> frames = kept.gallery();
  const std::size_t per_row = 1 + frames.front()->made.size();
  const std::size_t part_count = options.parts != nullptr ? options.parts->size() : 0;
  const std::size_t all = per_row * (frames.size() + shown.size() + part_count);
  Studio studio{
      .mesh = mesh, .options = {}, .sheet_labels = options.sheet_labels, .taken = 0, .all = all, .done = done};
  studio.options.width = picture_width(all);
  studio.options.height = static_cast<int>(studio.options.width / kAspect);
  studio.options.view = options.view;
  studio.options.up = options.up;
  studio.options.shading = Shading::kFlat;
  studio.options.wire_width = kWireWidth;
  studio.options.wireframe = studio.options.error_colors = true;
  studio.options.error_range = options.error_range;
  studio.options.color_bar = false;
  studio.options.ground = false;
  studio.options.background = kTransparent;

  PictureSet set{.gallery = {}, .parts = {}, .close_ups = {}, .error_range = options.error_range};
  for (const KeptFrames::Kept& frame : frames) {
    Result<PictureRow> row = studio.whole(*frame);
    if (!row) return row.error();
    set.gallery.push_back(std::move(*row));
  }
  for (std::size_t part = 0; part < part_count; ++part) {
    Result<PictureRow> row = studio.part(*frames.back(), options.parts->triangles(part));
    if (!row) return row.error();
    set.parts.push_back(std::move(*row));
  }
  for (const std::size_t method : shown) {
    Result<PictureRow> row = studio.worst(*kept.worst_of(method), places.of(method));
    if (!row) return row.error();
    set.close_ups.push_back({method, places.of(method), std::move(*row)});
  }
  return set;
}

}  // namespace limber::eval

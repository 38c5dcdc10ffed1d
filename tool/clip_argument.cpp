// SPDX-License-Identifier: Apache-2.0
#include "tool/clip_argument.h"

#include <utility>

#include "limber/clip/input_file.h"
#include "limber/stream/stream_reader.h"
#include "tool/frames_argument.h"
#include "tool/stream_file.h"

namespace limber::tool {
namespace {

// A stream as a clip, and the file that holds it.
class StreamFileReader final : public ClipReader {
 public:
  StreamFileReader(StreamFile file, std::unique_ptr<ClipReader> reader)
      : file_(std::move(file)), reader_(std::move(reader)) {}

  const Mesh& mesh() const override { return reader_->mesh(); }
  std::optional<std::uint32_t> frame_count() const override { return reader_->frame_count(); }
  Result<bool> read(std::span<Vec3f> positions) override { return reader_->read(positions); }
  Result<void> rewind() override { return reader_->rewind(); }
  double frames_per_second() const override { return reader_->frames_per_second(); }
  std::uint32_t first_frame_number() const override { return reader_->first_frame_number(); }

 private:
  StreamFile file_;
  std::unique_ptr<ClipReader> reader_;
};

}  // namespace

void declare_clip(CLI::App& app, ClipArgument& argument, const std::string& name) {
  app.add_option(name, argument.specification,
                 "a pattern ('horse/%04d.obj'), quoted glob or folder of .obj, .ply or .off frames; a .pc2 or .mdd; "
                 "a .limber stream; a generated sample ('sample:gallop?vertices=5000&frames=24'); or a single mesh")
      ->required();
  app.add_option("--mesh", argument.options.mesh,
                 "the mesh of a .pc2 or .mdd; found by itself where it is the only one")
      ->type_name("FILE");
  declare_frames(app, argument.options);
}

Result<std::unique_ptr<ClipReader>> open_any_clip(const ClipArgument& argument) {
  const std::string& name = argument.specification;
  if (name != "-" && lower_case_extension(name) != ".limber") return open_clip(name, argument.options);
  Result<StreamFile> file = StreamFile::open(name);
  if (!file) return file.error();
  auto reader = open_stream_clip(file->bytes(), argument.options, file->name());
  if (!reader) return reader.error();
  return std::unique_ptr<ClipReader>(std::make_unique<StreamFileReader>(std::move(*file), std::move(*reader)));
}

}  // namespace limber::tool

// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/sample.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "limber/clip/sample_motion.h"

namespace limber {
namespace {

struct Sample {
  std::string_view name;
  std::unique_ptr<SampleMotion> (*make)(Index vertex_count);
};

constexpr std::array<SampleInfo, 4> kInfos = {{
    {"collapse", "a horse of rubber sheet that falls in on itself on the floor"},
    {"gallop", "a galloping horse: periodic, with skin, tail and ears that follow"},
    {"morph", "a horse that turns into a man: hands grow out of hooves, the tail vanishes"},
    {"flag", "a flag in strong wind: open border, waves of several lengths"},
}};
constexpr std::array<Sample, 4> kSamples = {{
    {"collapse", make_collapse},
    {"gallop", make_gallop},
    {"morph", make_morph},
    {"flag", make_flag},
}};

struct Option {
  std::string_view name;
  std::uint32_t low, high, value;
  bool is_given = false;
};

class SampleReader : public ClipReader {
 public:
  SampleReader(std::unique_ptr<SampleMotion> motion, std::uint32_t frame_count)
      : motion_(std::move(motion)), frame_count_(frame_count) {}

  const Mesh& mesh() const override { return motion_->mesh(); }
  std::optional<std::uint32_t> frame_count() const override { return frame_count_; }
  Result<bool> read(std::span<Vec3f> positions) override {
    assert(positions.size() == mesh().vertex_count);
    if (frame_ == frame_count_) return false;
    motion_->pose(frame_++, frame_count_, positions);
    return true;
  }
  Result<void> rewind() override {
    frame_ = 0;
    return {};
  }

 private:
  std::unique_ptr<SampleMotion> motion_;
  std::uint32_t frame_count_ = 0;
  std::uint32_t frame_ = 0;
};

std::string quoted(std::string_view text) {
  std::string result(1, '"');
  result.append(text);
  result.push_back('"');
  return result;
}

Error refuse(std::string_view specification, std::string what) {
  return {ErrorCode::kBadInput, std::string(specification),
          std::move(what) +
              "; a sample is sample:collapse, sample:gallop, sample:morph or sample:flag, then perhaps "
              "?vertices=N&frames=N with 100 to 5000000 vertices and 1 to 100000 frames"};
}

}  // namespace

std::span<const SampleInfo> samples() { return kInfos; }

Result<std::unique_ptr<ClipReader>> open_sample(std::string_view specification) {
  constexpr std::string_view kScheme = "sample:";
  if (!specification.starts_with(kScheme)) return refuse(specification, "does not begin with \"sample:\"");
  const std::string_view rest = specification.substr(kScheme.size());
  const std::size_t question = rest.find('?');
  const std::string_view name = rest.substr(0, question);
  const auto sample = std::find_if(kSamples.begin(), kSamples.end(), [&](const Sample& s) { return s.name == name; });
  if (sample == kSamples.end()) return refuse(specification, "no sample is called " + quoted(name));

  std::array<Option, 2> options = {{{"vertices", 100, 5'000'000, 10'000}, {"frames", 1, 100'000, 60}}};
  std::string_view list = question == std::string_view::npos ? std::string_view{} : rest.substr(question + 1);
  if (question != std::string_view::npos && list.empty()) return refuse(specification, "nothing follows the \"?\"");
  while (question != std::string_view::npos) {
    const std::size_t end = list.find('&');
    const std::string_view item = list.substr(0, end);
    const std::size_t equals = item.find('=');
    const std::string_view key = item.substr(0, equals);
    const auto option = std::find_if(options.begin(), options.end(), [&](const Option& o) { return o.name == key; });
    if (option == options.end()) return refuse(specification, "no option is called " + quoted(key));
    if (option->is_given) return refuse(specification, quoted(key) + " is there twice");
    const std::string_view digits = equals == std::string_view::npos ? std::string_view{} : item.substr(equals + 1);
    const auto [after, code] = std::from_chars(digits.data(), digits.data() + digits.size(), option->value);
    if (code != std::errc{} || after != digits.data() + digits.size() || option->value < option->low ||
        option->value > option->high) {
      return refuse(specification, quoted(digits) + " is no fitting number of " + std::string(key));
    }
    option->is_given = true;
    if (end == std::string_view::npos) break;
    list = list.substr(end + 1);
  }
  return std::unique_ptr<ClipReader>(std::make_unique<SampleReader>(sample->make(options[0].value), options[1].value));
}

}  // namespace limber

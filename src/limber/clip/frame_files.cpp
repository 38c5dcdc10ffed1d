// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/frame_files.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <map>
#include <string>
#include <string_view>
#include <system_error>

#include "limber/clip/input_file.h"
#include "limber/clip/mesh_file.h"
#include "limber/clip/numbered_name.h"

namespace limber {
namespace {

namespace fs = std::filesystem;

struct NumberedFile {
  std::uint32_t number = 0;
  std::string name;
};

// Files in the order of their numbers; `pattern` names those that are missing.
struct Run {
  std::vector<NumberedFile> files;
  NumberedName pattern;
};

fs::path or_here(const fs::path& folder) { return folder.empty() ? fs::path(".") : folder; }

// The names of the files in `folder` that `fits` accepts, in natural order.
template <class Fits>
Result<std::vector<std::string>> list(const fs::path& folder, Fits fits) {
  std::error_code error;
  fs::directory_iterator entries(or_here(folder), error);
  if (error == std::errc::no_such_file_or_directory) {
    return Error{ErrorCode::kNotFound, folder.string(), "no such folder"};
  }
  std::vector<std::string> names;
  for (; !error && entries != fs::directory_iterator(); entries.increment(error)) {
    std::error_code ignored;
    const std::string name = entries->path().filename().string();
    if (fits(name) && entries->is_regular_file(ignored)) names.push_back(name);
  }
  if (error) return Error{ErrorCode::kIo, folder.string(), fmt::format("cannot be listed: {}", error.message())};
  std::sort(names.begin(), names.end(), natural_less);
  return names;
}

bool is_hidden(std::string_view name) { return name.starts_with('.'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

// The parts of a name, alternating: text (perhaps empty), digits, text, ...
std::vector<std::string_view> split_at_numbers(std::string_view name) {
  std::vector<std::string_view> parts;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= name.size(); ++i) {
    const bool in_digits = parts.size() % 2 == 1;
    if (i < name.size() && is_digit(name[i]) == in_digits) continue;
    parts.push_back(name.substr(begin, i - begin));
    begin = i;
  }
  return parts;
}

// The names as a run where one number, and nothing else, changes from name to name.
std::optional<Run> find_run(const std::vector<std::string>& names) {
  if (names.size() < 2) return std::nullopt;
  const std::vector<std::string_view> model = split_at_numbers(names.front());
  std::size_t changing = 0;
  for (const std::string& name : names) {
    const std::vector<std::string_view> parts = split_at_numbers(name);
    if (parts.size() != model.size()) return std::nullopt;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (parts[i] == model[i]) continue;
      if (i % 2 == 0 || (changing != 0 && changing != i)) return std::nullopt;
      changing = i;
    }
  }
  Run run;
  for (std::size_t i = 0; i < model.size(); ++i) {
    if (i != changing) (i < changing ? run.pattern.prefix : run.pattern.suffix) += model[i];
  }
  for (const std::string& name : names) {
    const std::string_view digits = split_at_numbers(name)[changing];
    NumberedFile file{0, name};
    if (std::from_chars(digits.data(), digits.data() + digits.size(), file.number).ec != std::errc{}) {
      return std::nullopt;
    }
    if (digits.size() > 1 && digits[0] == '0') run.pattern.digit_count = static_cast<std::uint32_t>(digits.size());
    run.files.push_back(std::move(file));
  }
  std::stable_sort(run.files.begin(), run.files.end(),
                   [](const NumberedFile& a, const NumberedFile& b) { return a.number < b.number; });
  return run;
}

// Files whose place in the order is their number.
Run number_by_order(std::vector<std::string> names) {
  Run run;
  for (std::string& name : names) run.files.push_back({static_cast<std::uint32_t>(run.files.size()), std::move(name)});
  return run;
}

// The files from options.first to options.last, which must all be there, at the steps asked for.
Result<FrameFiles> select(const Run& run, const fs::path& folder, const fs::path& where, const ClipOptions& options) {
  const std::uint32_t low = run.files.front().number;
  const std::uint32_t high = run.files.back().number;
  if (Result<void> done = check_range(options, low, high, where.string()); !done) return done.error();
  FrameFiles frames;
  frames.first_number = options.first.value_or(low);
  const std::uint32_t last = options.last.value_or(high);
  std::uint64_t expected = frames.first_number;
  for (std::size_t i = 0; i < run.files.size(); ++i) {
    const auto& [number, name] = run.files[i];
    if (number < frames.first_number || number > last) continue;
    if (i > 0 && run.files[i - 1].number == number) {
      return Error{ErrorCode::kBadInput, where.string(),
                   fmt::format("{} and {} are both frame {}", run.files[i - 1].name, name, number)};
    }
    if (number != expected) break;
    if ((number - frames.first_number) % options.step == 0) frames.paths.push_back(folder / name);
    ++expected;
  }
  if (expected <= last) {
    return Error{ErrorCode::kNotFound, (folder / run.pattern.name(expected)).string(),
                 fmt::format("is missing: the frames are numbered from {} to {}", low, high)};
  }
  return frames;
}

// Of names by extension, those that can be frames: the only extension, or the only one with a run.
Result<std::vector<std::string>> choose_extension(const std::vector<std::string>& names, const fs::path& where) {
  std::map<std::string, std::vector<std::string>> by_extension;
  for (const std::string& name : names) by_extension[lower_case_extension(name)].push_back(name);
  if (by_extension.size() == 1) return names;
  const std::vector<std::string>* chosen = nullptr;
  std::size_t run_count = 0;
  std::string found;
  for (const auto& [extension, group] : by_extension) {
    if (find_run(group)) chosen = &group, ++run_count;
    found += fmt::format("{}{} {}", found.empty() ? "" : ", ", group.size(), extension);
  }
  if (run_count == 1) return *chosen;
  return Error{ErrorCode::kBadInput, where.string(),
               fmt::format("holds mesh files of several kinds ({}); name the frames, as in '%04d{}' or '*{}'", found,
                           by_extension.begin()->first, by_extension.begin()->first)};
}

bool fits_glob(std::string_view name, std::string_view glob) {
  std::size_t n = 0;
  std::size_t g = 0;
  std::size_t star = std::string_view::npos;
  std::size_t star_end = 0;  // what the last star stands for ends here
  while (n < name.size()) {
    if (g < glob.size() && glob[g] == '*') {
      star = g++;
      star_end = n;
    } else if (g < glob.size() && (glob[g] == '?' || glob[g] == name[n])) {
      ++n, ++g;
    } else if (star != std::string_view::npos) {
      g = star + 1;
      n = ++star_end;
    } else {
      return false;
    }
  }
  while (g < glob.size() && glob[g] == '*') ++g;
  return g == glob.size();
}

}  // namespace

Result<void> check_range(const ClipOptions& options, std::uint32_t first, std::uint64_t last,
                         const std::string& where) {
  if (options.first && options.last && *options.first > *options.last) {
    return Error{ErrorCode::kBadInput, where,
                 fmt::format("the first frame, {}, lies after the last, {}", *options.first, *options.last)};
  }
  for (const std::optional<std::uint32_t>& asked : {options.first, options.last}) {
    if (!asked || (*asked >= first && *asked <= last)) continue;
    return Error{ErrorCode::kNotFound, where,
                 fmt::format("there is no frame {}: the frames are numbered from {} to {}", *asked, first, last)};
  }
  return {};
}

Result<FrameFiles> frames_of_pattern(const fs::path& pattern, const ClipOptions& options) {
  const Result<NumberedName> name = NumberedName::parse(pattern.filename().string());
  if (!name) return Error{name.error().code, pattern.string(), name.error().what};
  if (!mesh_format(name->name(0))) {
    return Error{ErrorCode::kUnsupported, pattern.string(), "frames must be .obj, .ply or .off files"};
  }
  const fs::path folder = pattern.parent_path();
  Result<std::vector<std::string>> names =
      list(folder, [&](std::string_view file) { return name->number(file).has_value(); });
  if (!names) return names.error();
  if (names->empty()) return Error{ErrorCode::kNotFound, pattern.string(), "no file fits this pattern"};
  Run run{{}, *name};
  for (std::string& file : *names) run.files.push_back({*name->number(file), std::move(file)});
  std::sort(run.files.begin(), run.files.end(),
            [](const NumberedFile& a, const NumberedFile& b) { return a.number < b.number; });
  return select(run, folder, pattern, options);
}

Result<FrameFiles> frames_of_glob(const fs::path& glob, const ClipOptions& options) {
  const fs::path folder = glob.parent_path();
  const std::string name = glob.filename().string();
  std::error_code ignored;
  if (folder.string().find_first_of("*?") != std::string::npos && !fs::is_directory(folder, ignored)) {
    return Error{ErrorCode::kBadInput, glob.string(), "* and ? may stand in the file name only, not in the folder"};
  }
  Result<std::vector<std::string>> names = list(folder, [&](std::string_view file) {
    return mesh_format(file) && fits_glob(file, name) && (!is_hidden(file) || is_hidden(name));
  });
  if (!names) return names.error();
  if (names->empty()) {
    return Error{ErrorCode::kNotFound, glob.string(), "no mesh file (.obj .ply .off) fits this name"};
  }
  names = choose_extension(*names, glob);
  if (!names) return names.error();
  std::optional<Run> run = find_run(*names);
  if (!run) run = number_by_order(std::move(*names));
  return select(*run, folder, glob, options);
}

Result<FrameFiles> frames_of_folder(const fs::path& folder, const ClipOptions& options) {
  Result<std::vector<std::string>> names =
      list(folder, [&](std::string_view file) { return mesh_format(file) && !is_hidden(file); });
  if (!names) return names.error();
  if (names->empty()) {
    return Error{ErrorCode::kNotFound, folder.string(), "has no mesh files (.obj .ply .off) in it"};
  }
  names = choose_extension(*names, folder);
  if (!names) return names.error();
  std::optional<Run> run = find_run(*names);
  if (!run && names->size() > 1) {
    return Error{
        ErrorCode::kBadInput, folder.string(),
        fmt::format("its files, from {} to {}, are not numbered in one way; name the frames, as in '%04d{}' or "
                    "'*{}'",
                    names->front(), names->back(), lower_case_extension(names->front()),
                    lower_case_extension(names->front()))};
  }
  if (!run) run = number_by_order(std::move(*names));
  return select(*run, folder, folder, options);
}

Result<FrameFiles> frames_of_file(const fs::path& file, const ClipOptions& options) {
  return select(number_by_order({file.filename().string()}), file.parent_path(), file, options);
}

}  // namespace limber

// SPDX-License-Identifier: Apache-2.0
// Runs the program's verbs in this process, and keeps a folder for each test.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <vector>

#include "tool/console.h"
#include "tool/program.h"

namespace limber::test {

struct Ran {
  tool::Exit exit = tool::Exit::kFailure;
  std::string out;
  std::string err;

  nlohmann::json json() const { return nlohmann::json::parse(out); }
};

// A file in memory.
class Capture {
 public:
  Capture() : file_(open_memstream(&data_, &size_)) {}
  Capture(const Capture&) = delete;
  ~Capture() {
    std::fclose(file_);
    std::free(data_);
  }
  std::FILE* file() const { return file_; }
  std::string text() const {
    std::fflush(file_);
    return {data_, size_};
  }

 private:
  char* data_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* file_;
};

inline Ran run(const std::vector<std::string>& arguments) {
  const Capture out, err;
  tool::Console console(out.file(), err.file());
  const tool::Exit exit = tool::run_program(arguments, console);
  return {exit, out.text(), err.text()};
}

// An empty folder of the test's own, removed when the test ends.
class ToolTest : public testing::Test {
 protected:
  ToolTest() {
    const testing::TestInfo& info = *testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) /
              ("limber-" + std::string(info.test_suite_name()) + "." + info.name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~ToolTest() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  // All names in the folder, hidden ones too.
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) found.push_back(entry.path().filename());
    return found;
  }

  static std::string bytes(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  static void write(const std::string& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
  }

  std::string stream(const std::string& name = "a.limber", std::vector<std::string> options = {}) const {
    std::vector<std::string> arguments{"build", kSample, "-o", path(name), "-q"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Ran built = run(arguments);
    EXPECT_EQ(built.exit, tool::Exit::kDone) << built.err;
    return path(name);
  }

  static constexpr const char* kSample = "sample:gallop?vertices=600&frames=8";

 private:
  std::filesystem::path folder_;
};

}  // namespace limber::test

// SPDX-License-Identifier: Apache-2.0
// What only a process shows: exit codes, signals, pipes, terminals.
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "tests/tool/run.h"

namespace limber::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using namespace std::chrono_literals;

const std::string kLimber = "'" LIMBER_PROGRAM "'";

class Process : public ToolTest {
 protected:
  // The exit code of a line for bash, which runs in the test's folder; what it says goes to the files out and err.
  int bash(const std::string& line) const {
    const std::string script = "cd '" + path("") + "' && { " + line + "; } >out 2>err";
    const int status = std::system(("bash -c \"set -o pipefail; " + script + "\"").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string out() const { return bytes(path("out")); }
  std::string err() const { return bytes(path("err")); }
};

TEST_F(Process, ExitCodesAreThoseOfTheConventions) {
  EXPECT_EQ(bash(kLimber + " --version"), 0);
  EXPECT_EQ(bash(kLimber + " build 'sample:flag?vertices=100&frames=2' -o a.limber"), 0);
  EXPECT_EQ(bash(kLimber + " build 'sample:flag?vertices=100&frames=2' -o a.limber"), 1);
  EXPECT_EQ(bash(kLimber + " bild"), 2);
  EXPECT_EQ(bash(kLimber + " info nowhere.limber"), 3);
  EXPECT_EQ(bash("truncate -s -1 a.limber; " + kLimber + " check a.limber"), 4);
}

TEST_F(Process, AReaderThatGoesAwayIsNoCrash) {
  EXPECT_EQ(bash("{ sleep 0.2; " + kLimber + " sample; } | true"), 0);
  EXPECT_THAT(err(), IsEmpty());
}

TEST_F(Process, AFullDiskIsAFailure) {
  EXPECT_EQ(bash(kLimber + " sample >/dev/full"), 1);
  EXPECT_THAT(err(), HasSubstr("No space left"));
}

TEST_F(Process, StreamsGoThroughPipes) {
  EXPECT_EQ(bash(kLimber + " build 'sample:flag?vertices=100&frames=2' -o - | " + kLimber + " check -"), 0);
  EXPECT_THAT(out(), HasSubstr("sound: 2 frames"));
}

TEST_F(Process, OnATerminalThereIsABarAndNoColorIsHeeded) {
  const std::string build = " build 'sample:flag?vertices=100&frames=20' -f -o a.limber";
  const auto on_a_terminal = [&](const std::string& variables, const std::string& options) {
    EXPECT_EQ(bash("env -u NO_COLOR TERM=xterm " + variables + " script -qec \\\"" + kLimber + build + options +
                   "\\\" /dev/null"),
              0);
    return out();
  };
  EXPECT_THAT(on_a_terminal("", ""), HasSubstr("\x1b[32m"));
  EXPECT_THAT(on_a_terminal("NO_COLOR=1", ""), testing::AllOf(HasSubstr("/20 frames"), Not(HasSubstr("\x1b[32m"))));
  EXPECT_THAT(on_a_terminal("", " -q"), Not(HasSubstr("\r\x1b[K")));
}

TEST_F(Process, AnInterruptedBuildLeavesWhatWasThereAndNothingElse) {
  for (const int signal : {SIGINT, SIGTERM}) {
    write(path("a.limber"), "mine");
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      const int null = open("/dev/null", O_WRONLY);
      dup2(null, STDOUT_FILENO);
      dup2(null, STDERR_FILENO);
      execl(LIMBER_PROGRAM, "limber", "build", "sample:flag?vertices=600&frames=100000", "--base-frames", "1", "-f",
            "-o", path("a.limber").c_str(), nullptr);
      _exit(127);
    }
    for (int i = 0; i < 12000 && names().size() < 2; ++i) std::this_thread::sleep_for(10ms);
    EXPECT_EQ(names().size(), 2u) << "no temporary file has appeared";
    std::this_thread::sleep_for(100ms);
    kill(child, signal);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 130) << status;
    EXPECT_EQ(bytes(path("a.limber")), "mine");
    EXPECT_THAT(names(), testing::ElementsAre("a.limber"));
  }
}

TEST_F(Process, CompletionKnowsVerbsOptionsAndSamples) {
  const auto complete = [this](const std::string& words, int at) {
    const std::string script = LIMBER_SOURCE_DIR "/tool/limber.bash-completion";
    EXPECT_EQ(bash("mkdir -p bin; ln -sf " + kLimber + " bin/limber; PATH=\\$PWD/bin:\\$PATH; . '" + script +
                   "'; COMP_WORDS=(" + words + "); COMP_CWORD=" + std::to_string(at) +
                   "; _limber; printf '%s\\n' \\\"\\${COMPREPLY[@]}\\\""),
              0)
        << err();
    return out();
  };
  EXPECT_EQ(complete("limber bu", 1), "build\n");
  EXPECT_THAT(complete("limber build --bran", 2), HasSubstr("--branching\n"));
  EXPECT_THAT(complete("limber sample ga", 2), HasSubstr("gallop\n"));
  EXPECT_THAT(complete("limber build --topology f", 3), HasSubstr("free\n"));
}

TEST_F(Process, AMeshGoesToStandardOutputAsIntoAFile) {
  const std::string file = stream();
  for (const std::string format : {"obj", "ply", "off"}) {
    EXPECT_EQ(bash(kLimber + " extract a.limber --frame 3 --vertices 100 -o - --format " + format), 0);
    ASSERT_EQ(run({"extract", file, "--frame", "3", "--vertices", "100", "-o", path("b." + format)}).exit,
              tool::Exit::kDone);
    EXPECT_EQ(bytes(path("out")), bytes(path("b." + format)));
    EXPECT_THAT(bytes(path("err")), HasSubstr("frame 3"));
  }
  EXPECT_EQ(bash(kLimber + " simplify b.obj --method direct --vertices 50 -o -"), 0);
  EXPECT_THAT(bytes(path("out")), testing::StartsWith("v "));
}

TEST_F(Process, StandardOutputTakesOneMeshAndNoJsonBesides) {
  stream();
  EXPECT_EQ(bash(kLimber + " extract a.limber --vertices 100 -o -"), 2);
  EXPECT_EQ(bash(kLimber + " extract a.limber --frame 3 -o - --json"), 2);
  EXPECT_EQ(bash(kLimber + " simplify '" + kSample + "' --method direct --vertices 50 -o -"), 2);
  EXPECT_THAT(bytes(path("out")), IsEmpty());
}

}  // namespace
}  // namespace limber::test

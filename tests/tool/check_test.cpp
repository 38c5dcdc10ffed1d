// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "tests/tool/run.h"

namespace limber::test {
namespace {

using testing::HasSubstr;
using tool::Exit;
using Check = ToolTest;

TEST_F(Check, ASoundStreamPasses) {
  const Ran ran = run({"check", stream(), "--all", "--against", kSample, "--json"});
  EXPECT_EQ(ran.exit, Exit::kDone) << ran.err;
  EXPECT_EQ(ran.json()["schema"], "limber.check/1");
  EXPECT_EQ(ran.json()["passed"], true);
  EXPECT_EQ(ran.json()["sought"], 8);
}

TEST_F(Check, AFlippedByteAnywhereIsFound) {
  const std::string whole = bytes(stream("a.limber", {"--last", "1"}));
  for (std::size_t i = 0; i < whole.size(); i += 61) {
    std::string broken = whole;
    broken[i] = static_cast<char>(broken[i] ^ 0x10);
    write(path("b.limber"), broken);
    const Ran ran = run({"check", path("b.limber")});
    EXPECT_TRUE(ran.exit == Exit::kBadInput || ran.exit == Exit::kCheckFailed) << "byte " << i;
  }
}

TEST_F(Check, ADamagedFrameIsACheckThatFailed) {
  std::string broken = bytes(stream());
  broken[broken.size() * 2 / 3] ^= 1;
  write(path("b.limber"), broken);
  const Ran ran = run({"check", path("b.limber"), "--json"});
  EXPECT_EQ(ran.exit, Exit::kCheckFailed);
  EXPECT_EQ(ran.json()["failed"], "checksum");
}

TEST_F(Check, AStreamCutAnywhereIsFound) {
  const std::string whole = bytes(stream("a.limber", {"--last", "1"}));
  for (std::size_t size = 0; size < whole.size(); size += 97) {
    write(path("b.limber"), whole.substr(0, size));
    const Ran ran = run({"check", path("b.limber")});
    EXPECT_TRUE(ran.exit == Exit::kBadInput || ran.exit == Exit::kCheckFailed) << size << " bytes";
  }
  write(path("b.limber"), whole.substr(0, whole.size() - 1));
  EXPECT_THAT(run({"check", path("b.limber")}).out, HasSubstr("whole"));
}

TEST_F(Check, AnotherClipIsToldApart) {
  const std::string file = stream();
  EXPECT_THAT(run({"check", file, "--against", "sample:flag?vertices=600&frames=8"}).out, HasSubstr("matches-clip"));
  EXPECT_THAT(run({"check", file, "--against", kSample, "--last", "6"}).out, HasSubstr("matches-clip"));
  const Ran later = run({"check", file, "--against", "sample:gallop?vertices=600&frames=9", "--first", "1"});
  EXPECT_EQ(later.exit, Exit::kCheckFailed);
  EXPECT_THAT(later.out, HasSubstr("frame 0: within-tolerance"));
}

TEST_F(Check, WhatIsNoStreamIsBadInput) {
  write(path("a.limber"), "solid cube");
  EXPECT_EQ(run({"check", path("a.limber")}).exit, Exit::kBadInput);
  write(path("a.limber"), "");
  EXPECT_EQ(run({"check", path("a.limber")}).exit, Exit::kBadInput);
  EXPECT_EQ(run({"check", path("")}).exit, Exit::kBadInput);
}

}  // namespace
}  // namespace limber::test

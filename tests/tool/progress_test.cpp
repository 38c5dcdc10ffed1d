// SPDX-License-Identifier: Apache-2.0
#include "tool/progress.h"

#include <gtest/gtest.h>

namespace limber::tool {
namespace {

TEST(ProgressLine, HasABarARateAndTheTimeLeft) {
  EXPECT_EQ(progress_line("building", 15, 60, 3.0), "building [======>                 ] 15/60 frames  5/s  9 s left");
  EXPECT_EQ(progress_line("building", 60, 60, 12.0), "building [========================] 60/60 frames  5/s  0 s left");
}

TEST(ProgressLine, LongTimesAreMinutesAndHours) {
  EXPECT_NE(progress_line("x", 1, 101, 1.0).find("1:40 min left"), std::string::npos);
  EXPECT_NE(progress_line("x", 1, 7501, 1.0).find("2:05 h left"), std::string::npos);
}

TEST(ProgressLine, WithoutATotalThereIsNoBar) {
  EXPECT_EQ(progress_line("reading", 8, {}, 2.0), "reading  8 frames  4/s");
  EXPECT_EQ(progress_line("reading", 0, {}, 0.0), "reading  0 frames");
}

TEST(ProgressLine, MoreThanTheTotalIsTheTotal) {
  EXPECT_NE(progress_line("x", 9, 8, 1.0).find(" 8/8 frames"), std::string::npos);
}

}  // namespace
}  // namespace limber::tool

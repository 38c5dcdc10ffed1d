// SPDX-License-Identifier: Apache-2.0
#include "limber/base/result.h"

#include <gtest/gtest.h>
#include <memory>

namespace limber {
namespace {

TEST(Result, WithAValueIsTrueAndGivesIt) {
  Result<std::string> result = std::string("frames");
  ASSERT_TRUE(result);
  EXPECT_EQ(*result, "frames");
  EXPECT_EQ(result->size(), 6u);
  *result += "!";
  EXPECT_EQ(*result, "frames!");
}

TEST(Result, WithAnErrorIsFalseAndGivesIt) {
  const Result<std::string> result = Error{ErrorCode::kMismatch, "0002.obj", "it has 3 vertices more"};
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kMismatch);
  EXPECT_EQ(result.error().line(), "0002.obj: it has 3 vertices more");
}

TEST(Result, OfFalseIsAValue) {
  const Result<bool> at_end = false;
  ASSERT_TRUE(at_end);
  EXPECT_FALSE(*at_end);
}

TEST(Result, HoldsWhatCanOnlyBeMoved) {
  Result<std::unique_ptr<int>> result = std::make_unique<int>(7);
  ASSERT_TRUE(result);
  const std::unique_ptr<int> taken = std::move(*result);
  EXPECT_EQ(*taken, 7);
}

TEST(Result, OfNothingIsTrueUnlessItHoldsAnError) {
  EXPECT_TRUE(Result<void>());
  const Result<void> refused = Error{ErrorCode::kIo, "out.pc2", "the disk is full"};
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kIo);
}

TEST(Error, WithoutAPlaceIsJustWhatIsWrong) { EXPECT_EQ((Error{ErrorCode::kIo, "", "no space"}.line()), "no space"); }

}  // namespace
}  // namespace limber

// SPDX-License-Identifier: Apache-2.0
#include "tool/suggest.h"

#include <gtest/gtest.h>

namespace limber::tool {
namespace {

const std::vector<std::string> kWords = {"build", "info", "extract", "simplify"};

TEST(Nearest, ForgivesALetterAndLettersExchanged) {
  EXPECT_EQ(nearest("biuld", kWords), "build");
  EXPECT_EQ(nearest("extrakt", kWords), "extract");
  EXPECT_EQ(nearest("inf", kWords), "info");
}

TEST(Nearest, KnowsABeginning) { EXPECT_EQ(nearest("simp", kWords), "simplify"); }

TEST(Nearest, GivesNothingWhereNothingIsNear) {
  EXPECT_EQ(nearest("render", kWords), "");
  EXPECT_EQ(nearest("", kWords), "");
}

}  // namespace
}  // namespace limber::tool

// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/numbered_name.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

#include "tests/clip/sample_meshes.h"

namespace limber {
namespace {

std::string name(std::string_view pattern, std::uint64_t number) {
  const Result<NumberedName> parsed = NumberedName::parse(pattern);
  return parsed ? parsed->name(number) : parsed.error().line();
}

TEST(NumberedName, MakesTheNamesThatPrintfMakes) {
  EXPECT_EQ(name("%d.obj", 7), "7.obj");
  EXPECT_EQ(name("a%04d.obj", 7), "a0007.obj");
  EXPECT_EQ(name("a%04d.obj", 123456), "a123456.obj");
  EXPECT_EQ(name("%i_100%%.obj", 7), "7_100%.obj");
  EXPECT_EQ(name("%03u", 0), "000");
}

TEST(NumberedName, KnowsOnlyTheNamesThatItMakes) {
  const NumberedName padded = *NumberedName::parse("a%03d.obj");
  EXPECT_EQ(padded.number("a012.obj"), 12u);
  EXPECT_EQ(padded.number("a1234.obj"), 1234u);
  EXPECT_EQ(padded.number("a12.obj"), std::nullopt);
  EXPECT_EQ(padded.number("a0012.obj"), std::nullopt);
  EXPECT_EQ(padded.number("a.obj"), std::nullopt);
  EXPECT_EQ(padded.number("b012.obj"), std::nullopt);
  EXPECT_EQ(padded.number("a-12.obj"), std::nullopt);
  EXPECT_EQ(padded.number("a99999999999.obj"), std::nullopt);
  EXPECT_EQ(NumberedName::parse("%d.obj")->number("01.obj"), std::nullopt);
}

TEST(NumberedName, RefusesPatternsWithoutExactlyOneNumber) {
  for (const std::string pattern : {"a.obj", "%%.obj", "%d%d.obj", "%s.obj", "%4d.obj", "%.3d", "%", "%04", "%0123d"}) {
    EXPECT_ERROR(NumberedName::parse(pattern), kBadInput, "a pattern needs one frame number");
  }
}

TEST(NaturalOrder, CountsDigitsAsNumbers) {
  const std::vector<std::string> sorted{"1.obj", "01.obj", "2.obj", "10.obj", "a", "a1b2", "a1b10", "a2b1", "b"};
  std::vector<std::string> names(sorted.rbegin(), sorted.rend());
  std::sort(names.begin(), names.end(), natural_less);
  EXPECT_THAT(names, testing::UnorderedElementsAreArray(sorted));
  EXPECT_LT(std::find(names.begin(), names.end(), "2.obj"), std::find(names.begin(), names.end(), "10.obj"));
  EXPECT_LT(std::find(names.begin(), names.end(), "a1b2"), std::find(names.begin(), names.end(), "a1b10"));
  EXPECT_LT(std::find(names.begin(), names.end(), "a1b10"), std::find(names.begin(), names.end(), "a2b1"));
}

TEST(NaturalOrder, IsAStrictOrder) {
  const std::vector<std::string> names{
      "", "0", "00", "1", "01", "1a", "01a", "a", "a0", "a00b", "a0c", "-1", "99999999999999999999999"};
  for (const std::string& a : names) {
    EXPECT_FALSE(natural_less(a, a));
    for (const std::string& b : names) {
      EXPECT_EQ(a != b, natural_less(a, b) || natural_less(b, a)) << a << " " << b;
      EXPECT_FALSE(natural_less(a, b) && natural_less(b, a)) << a << " " << b;
      for (const std::string& c : names) {
        EXPECT_TRUE(!natural_less(a, b) || !natural_less(b, c) || natural_less(a, c)) << a << " " << b << " " << c;
      }
    }
  }
}

}  // namespace
}  // namespace limber

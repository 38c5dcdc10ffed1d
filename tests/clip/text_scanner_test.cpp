// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/text_scanner.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace limber {
namespace {

// The number that is the text, or NaN where it is none.
float number(std::string_view text) {
  TextScanner scanner(text);
  float value = 0;
  return scanner.read(value) ? value : std::nanf("");
}

TEST(TextScanner, ReadsNumbersInAllTheirForms) {
  EXPECT_EQ(number("1"), 1.0f);
  EXPECT_EQ(number("\t +1.5 "), 1.5f);
  EXPECT_EQ(number("-.25"), -0.25f);
  EXPECT_EQ(number("3."), 3.0f);
  EXPECT_EQ(number("1E+2"), 100.0f);
  EXPECT_EQ(number("1e-5#comment"), 1e-5f);
}

TEST(TextScanner, RefusesWordsThatOnlyStartWithANumber) {
  EXPECT_TRUE(std::isnan(number("1,5")));
  EXPECT_TRUE(std::isnan(number("1.#QNAN")) || number("1.#QNAN") == 1.0f);
  EXPECT_TRUE(std::isnan(number("0x10")));
  EXPECT_TRUE(std::isnan(number("1.0.0")));
  EXPECT_TRUE(std::isnan(number("")));
  EXPECT_TRUE(std::isnan(number("-")));
}

TEST(TextScanner, MakesZeroOfWhatIsTooSmallAndInfinityOfWhatIsTooLarge) {
  EXPECT_EQ(number("1e-60"), 0.0f);
  EXPECT_EQ(number("-1e-400"), 0.0f);
  EXPECT_EQ(number("1e-40"), 1e-40f);
  EXPECT_TRUE(std::isinf(number("1e39")));
  EXPECT_TRUE(std::isinf(number("1e400")));
}

TEST(TextScanner, CountsLinesWhateverTheirEnd) {
  for (const std::string_view text : {"a\nb\nc", "a\r\nb\r\nc", "a\rb\rc", "a\n\rc"}) {
    TextScanner scanner(text);
    scanner.skip_line();
    scanner.skip_line();
    EXPECT_EQ(scanner.line(), 3u);
    EXPECT_EQ(scanner.word(), "c");
    EXPECT_TRUE(scanner.at_end());
  }
}

TEST(TextScanner, JoinsLinesAtABackslash) {
  TextScanner scanner("1 \\\n 2\\\r\n3\n4");
  std::int64_t value = 0;
  for (std::int64_t expected = 1; expected <= 3; ++expected) {
    ASSERT_TRUE(scanner.read(value));
    EXPECT_EQ(value, expected);
  }
  scanner.skip_blanks();
  EXPECT_TRUE(scanner.at_line_end());
  EXPECT_EQ(scanner.line(), 3u);
}

TEST(TextScanner, SkipsCommentsAndEmptyLinesToTheNextWord) {
  TextScanner scanner("# one\n\n  # two\n\t three");
  scanner.skip_to_word();
  EXPECT_EQ(scanner.line(), 4u);
  EXPECT_EQ(scanner.word(), "three");
}

TEST(TextScanner, DoesNotMoveOverWhatIsNoInteger) {
  TextScanner scanner("7x");
  std::int64_t value = 0;
  EXPECT_FALSE(scanner.read(value));
  EXPECT_EQ(scanner.word(), "7x");
}

}  // namespace
}  // namespace limber

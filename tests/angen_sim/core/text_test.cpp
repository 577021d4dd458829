#include "core/text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace angen {
namespace {

TEST(ValidUtf8, IsWhatUnicodeAllows) {
  for (const char* good : {"", "plain", "Küche", "\xE2\x82\xAC", "\xF0\x9F\x8F\xA0"}) {
    EXPECT_TRUE(valid_utf8(good)) << good;
  }
  const char* const bad[] = {"\xFF",
                             "\x80",
                             "a\xC3",
                             "\xC0\xAF",
                             "\xE0\x80\xAF",
                             "\xED\xA0\x80",
                             "\xF4\x90\x80\x80",
                             "\xF0\x80\x80\x80",
                             "\xC3"
                             "a"};
  for (const char* text : bad) EXPECT_FALSE(valid_utf8(text)) << printable(text);
}

TEST(ValidUtf8, PrefixEndsBeforeTheFirstBadByte) {
  EXPECT_EQ(valid_utf8_prefix("ü\xFFz"), 2U);
  EXPECT_EQ(valid_utf8_prefix("abc"), 3U);
}

TEST(Trimmed, LosesBlanksAtBothEndsOnly) {
  EXPECT_EQ(trimmed(" \t a b\r\n"), "a b");
  EXPECT_EQ(trimmed("  "), "");
}

TEST(Printable, ReplacesWhatALogCannotShow) {
  EXPECT_EQ(printable("a\nb\x7F\xFF"), "a?b??");
  EXPECT_EQ(printable("ü"), "ü");
  EXPECT_EQ(printable("abcdef", 3), "abc… (6 bytes)");
  EXPECT_EQ(printable("aüb", 2), "a… (4 bytes)") << "no character is cut in two";
}

TEST(Shortened, EndsAtAWholeCharacterWithTheLength) {
  EXPECT_EQ(shortened("abc", 3), "abc");
  EXPECT_EQ(shortened("a\nbcdef", 3), "a\nb… (7 bytes)");
  EXPECT_EQ(shortened("aüb", 2), "a… (4 bytes)");
  EXPECT_EQ(shortened("a\U0001F600b", 4), "a… (6 bytes)");
  EXPECT_EQ(shortened(std::string(1000000, 'x'), 3), "xxx… (1000000 bytes)");
  EXPECT_EQ(shortened("\x80\x80\x80\x80\x80", 4), "\x80\x80\x80\x80… (5 bytes)");
}

TEST(ParseNumber, TakesTheWholeTextInTheCLocale) {
  EXPECT_EQ(parse_number("1.5"), 1.5);
  EXPECT_EQ(parse_number("+2e3"), 2000.0);
  EXPECT_EQ(parse_number("-inf"), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(parse_number("nan").value()));
  for (const char* bad : {"", "+", "+-1", "1,5", "1 ", " 1", "0x10", "1e999", "one"}) {
    EXPECT_FALSE(parse_number(bad)) << bad;
  }
}

TEST(ParseNumber, FiniteOrWholeWhereAsked) {
  EXPECT_EQ(parse_finite("1.5"), 1.5);
  EXPECT_FALSE(parse_finite("inf"));
  EXPECT_FALSE(parse_finite("nan"));
  EXPECT_EQ(parse_integer("-7"), -7);
  EXPECT_FALSE(parse_integer("7.0"));
  EXPECT_FALSE(parse_integer("99999999999"));
}

TEST(NumberText, ReadsAsTheSameNumber) {
  for (const double value : {0.1, 1.0 / 3.0, -2e300, 5e-324, 40.0}) {
    EXPECT_EQ(parse_number(number_text(value)), value);
  }
  EXPECT_EQ(number_text(40.0), "40");
  EXPECT_EQ(number_text(-std::nan("")), "nan");
}

}  // namespace
}  // namespace angen

#include "core/typography.h"

#include <gtest/gtest.h>

namespace angen {
namespace {

TEST(Typography, IsFoundWithItsCode) {
  const auto found = find_typographic("a \u2212 b \u201C");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->at, 2U);
  EXPECT_EQ(found->size, 3U);
  EXPECT_EQ(found->name, "\u2212 (U+2212)");
  EXPECT_EQ(found->plain, '-');
  EXPECT_EQ(find_typographic("a \u2212 b \u201C", 5)->plain, '"');
  EXPECT_EQ(find_typographic("\u00A0")->name, "a blank (U+00A0)");
  EXPECT_FALSE(find_typographic("K\u00fcche -1 \"x\""));
  EXPECT_FALSE(find_typographic("", 7));
}

TEST(Typography, IsReplacedByAscii) {
  EXPECT_EQ(without_typography("\u201COpen,\u00A0bath\u201D \u22121 \u20131"),
            "\"Open, bath\" -1 -1");
  EXPECT_EQ(without_typography("K\u00fcche"), "K\u00fcche");
}

TEST(Typography, QuotesAndBlanksAroundATextAreDropped) {
  EXPECT_EQ(unquoted("\u201DOpen, bathroom1\u201D"), "Open, bathroom1");
  EXPECT_EQ(unquoted(" \u00A0\u2018 a \u2019 "), "a");
  EXPECT_EQ(unquoted("\"a\""), "a");
  EXPECT_EQ(unquoted("\u201E\u201C"), "");
  EXPECT_EQ(unquoted("the kids'"), "the kids'");
  EXPECT_EQ(unquoted("\""), "\"");
  EXPECT_EQ(unquoted("\u22121"), "\u22121");
}

TEST(Typography, NumbersAreReadAsMeant) {
  EXPECT_EQ(plain_numbers("\u22129.37 6.5\u00A00.1e\u20133"), "-9.37 6.5 0.1e-3");
  EXPECT_FALSE(plain_numbers("-9.37 6.5"));
  EXPECT_FALSE(plain_numbers("from \u22121 to 1"));
  EXPECT_FALSE(plain_numbers("\u00A0"));
}

}  // namespace
}  // namespace angen

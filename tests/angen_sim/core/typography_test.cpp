#include "core/typography.h"

#include <gtest/gtest.h>

namespace angen {
namespace {

TEST(Typography, IsReplacedByAscii) {
  EXPECT_EQ(straightened("\u201COpen,\u00A0bath\u201D \u22121 \u20131\u00AD2"),
            "\"Open, bath\" -1 -12");
  for (const char* const text : {"K\u00fcche -1 \"x\"", "\u6771\u4eac", "", "a\x80\xff"}) {
    EXPECT_EQ(straightened(text), text);
  }
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
  for (const char* const text : {"-9.37 6.5", "from \u22121 to 1", "\u00A0"}) {
    EXPECT_EQ(plain_numbers(text), text);
  }
}

}  // namespace
}  // namespace angen

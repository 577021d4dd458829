#include "core/diagnostics.h"

#include <gtest/gtest.h>

namespace angen {
namespace {

TEST(Diagnostic, TextNamesFileAndLine) {
  Diagnostic d;
  d.message = "wrong";
  EXPECT_EQ(d.text(), "wrong");
  d.source = {"a.world", 0};
  EXPECT_EQ(d.text(), "a.world: wrong");
  d.source.line = 7;
  EXPECT_EQ(d.text(), "a.world:7: wrong");
}

TEST(Error, WhatHasOneLineForEach) {
  const Error error(std::vector<Diagnostic>{{Diagnostic::Severity::kError, {"a", 1}, "x"},
                                            {Diagnostic::Severity::kError, {"b", 2}, "y"}});
  EXPECT_STREQ(error.what(), "a:1: x\nb:2: y");
  EXPECT_EQ(error.diagnostics().size(), 2U);
}

TEST(Error, RepeatsOnlySoMuchOfWhatAUserGave) {
  const Error error(std::string(100'000, 'n'));
  EXPECT_LT(std::string(error.what()).size(), 4010U);
}

TEST(JoinNames, NamesTheFirstAndCountsTheRest) {
  EXPECT_EQ(join_names({}), "(none)");
  EXPECT_EQ(join_names({"a", "b"}), "a, b");
  EXPECT_EQ(join_names({"a", "b", "c", "d"}, 2), "a, b and 2 more");
}

}  // namespace
}  // namespace angen

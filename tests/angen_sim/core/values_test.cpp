#include <gtest/gtest.h>

#include "core/diagnostics.h"
#include "core/element.h"
#include "core/slots.h"
#include "core/time.h"

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

TEST(JoinNames, NamesTheFirstAndCountsTheRest) {
  EXPECT_EQ(join_names({}), "(none)");
  EXPECT_EQ(join_names({"a", "b"}), "a, b");
  EXPECT_EQ(join_names({"a", "b", "c", "d"}, 2), "a, b and 2 more");
}

TEST(Element, FindsChildrenAndAttributes) {
  Element e;
  e.attributes = {{"k", "v"}};
  e.children.resize(1);
  e.children[0].name = "c";
  EXPECT_EQ(e.child("c"), &e.children[0]);
  EXPECT_EQ(e.child("d"), nullptr);
  EXPECT_EQ(*e.attribute("k"), "v");
  EXPECT_EQ(e.attribute("x"), nullptr);
}

struct Tag;

TEST(Slots, AnIdNeverNamesItsSuccessor) {
  Slots<int, Tag> slots;
  const Id<Tag> a = slots.add(1);
  const Id<Tag> b = slots.add(2);
  slots.remove(a);
  EXPECT_FALSE(slots.contains(a));
  EXPECT_THROW(slots.at(a), std::out_of_range);
  EXPECT_THROW(slots.remove(a), std::out_of_range);
  const Id<Tag> c = slots.add(3);
  EXPECT_EQ(c.index, a.index);
  EXPECT_NE(c, a);
  EXPECT_EQ(slots.at(b), 2);
  EXPECT_EQ(slots.at(c), 3);
  EXPECT_EQ(slots.size(), 2U);
}

TEST(Slots, AreVisitedInIndexOrder) {
  Slots<int, Tag> slots;
  const Id<Tag> first = slots.add(1);
  slots.add(2);
  slots.add(3);
  slots.remove(first);
  slots.add(4);
  std::vector<int> seen;
  slots.each([&](Id<Tag>, int value) { seen.push_back(value); });
  EXPECT_EQ(seen, (std::vector<int>{4, 2, 3}));
}

TEST(Time, SecondsRoundToTheNearestNanosecond) {
  EXPECT_EQ(from_seconds(0.001), 1'000'000);
  EXPECT_EQ(from_seconds(0.1 + 0.2), 300'000'000);
  EXPECT_EQ(from_seconds(-1e-9), -1);
  EXPECT_DOUBLE_EQ(to_seconds(1'500'000'000), 1.5);
}

}  // namespace
}  // namespace angen

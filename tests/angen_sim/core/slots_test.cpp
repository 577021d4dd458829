#include "core/slots.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace angen {
namespace {

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

}  // namespace
}  // namespace angen

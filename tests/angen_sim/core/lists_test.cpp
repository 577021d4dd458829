#include "core/lists.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace angen {
namespace {

TEST(Lists, AnEntryIsFoundByItsValue) {
  const std::array<const char*, 2> names{"bed", "sofa"};
  EXPECT_TRUE(is_in(std::string("sofa"), names));
  EXPECT_FALSE(is_in(std::string("so"), names));
  EXPECT_FALSE(is_in(1, std::vector<int>{}));
}

TEST(Lists, RemovedEntriesLeaveTheOthersInOrder) {
  std::vector<int> numbers{5, 2, 4, 1, 3};
  erase_if(numbers, [](int number) { return number % 2 == 0; });
  EXPECT_EQ(numbers, (std::vector<int>{5, 1, 3}));
}

}  // namespace
}  // namespace angen

#include "core/named.h"

#include <gtest/gtest.h>

#include <memory>

namespace angen::testing {
namespace {

struct Part {
  std::string name;
};

TEST(Named, EntriesAreFoundByTheirNamesTheFirstOfTwo) {
  const std::vector<Part> parts{{"a"}, {"b"}, {"b"}};
  EXPECT_EQ(names_in(parts), (std::vector<std::string>{"a", "b", "b"}));
  EXPECT_EQ(index_in(parts, "b"), 1U);
  EXPECT_FALSE(index_in(parts, "c"));
}

TEST(Named, EntriesMayBePointers) {
  const std::vector<std::shared_ptr<const Part>> parts{std::make_shared<const Part>(Part{"a"})};
  EXPECT_EQ(names_in(parts), std::vector<std::string>{"a"});
  EXPECT_EQ(index_in(parts, "a"), 0U);
}

}  // namespace
}  // namespace angen::testing

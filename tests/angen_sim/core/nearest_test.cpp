#include "core/nearest.h"

#include <gtest/gtest.h>

namespace angen {
namespace {

TEST(Nearest, AreOrderedByEditDistance) {
  const std::vector<std::string> known{"kitchen1", "bathroom0", "kitchen0", "hall0"};
  EXPECT_EQ(nearest_names("kitchn0", known),
            (std::vector<std::string>{"kitchen0", "kitchen1", "hall0"}));
  EXPECT_EQ(nearest_names("HALL0", known, 1), std::vector<std::string>{"hall0"});
}

TEST(Nearest, IsAQuestion) {
  EXPECT_EQ(did_you_mean("x", {}), "there are none");
  EXPECT_EQ(did_you_mean("a", {"b"}), "did you mean b?");
  EXPECT_EQ(did_you_mean("a", {"b", "ab"}), "did you mean ab or b?");
}

TEST(Nearest, OfALongNameIsQuick) {
  EXPECT_EQ(nearest_names(std::string(1000000, 'x'), {"a"}).size(), 1U);
}

}  // namespace
}  // namespace angen

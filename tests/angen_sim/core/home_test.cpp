#include "core/home.h"

#include <gtest/gtest.h>

namespace angen {
namespace {

TEST(Storey, AtAHeightIsTheHighestBelow) {
  const std::vector<Storey> storeys = {
      {-1, "cellar", -2.6, 2.6}, {0, "ground", 0.0, 3.2}, {1, "attic", 3.2, 2.5}};
  EXPECT_EQ(floor_at(storeys, -4.0), -1);
  EXPECT_EQ(floor_at(storeys, -0.6), -1);
  EXPECT_EQ(floor_at(storeys, -0.4), 0);
  EXPECT_EQ(floor_at(storeys, 2.6), 0);
  EXPECT_EQ(floor_at(storeys, 2.8), 1);
  EXPECT_EQ(floor_at(storeys, 9.0), 1);
  EXPECT_EQ(floor_at({}, 4.0), 0);
}

}  // namespace
}  // namespace angen

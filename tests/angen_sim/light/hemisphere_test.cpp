#include "light/hemisphere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace angen::light {
namespace {

/// Ring and part of its circle, of 16 and 128 of equal cosine-weighted solid angle.
using Cell = std::pair<int, int>;

Cell cell_of(const Vec3& about_x) {
  const double across2 = about_x.y() * about_x.y() + about_x.z() * about_x.z();
  const double turns = std::atan2(about_x.z(), about_x.y()) / (2.0 * M_PI);
  const double part = 128.0 * (turns - std::floor(turns));
  // The first direction of a part lies on its border.
  return {static_cast<int>(16.0 * across2), static_cast<int>(part + 1e-6) % 128};
}

TEST(Hemisphere, EachCellHasOneDirectionAndItsFineOnes) {
  std::set<Cell> taken;
  for (std::size_t i = 0; i < kDirections; ++i) {
    const Cell own = cell_of(gather_directions()[i]);
    EXPECT_TRUE(taken.insert(own).second) << i;
    for (const Vec3& fine : fine_directions(i)) EXPECT_EQ(cell_of(fine), own) << i;
  }
}

TEST(Hemisphere, NeighborsAreBeside) {
  for (std::size_t i = 0; i < kDirections; ++i) {
    const auto [ring, part] = cell_of(gather_directions()[i]);
    std::set<Cell> expected{{ring, (part + 1) % 128},
                            {ring, (part + 127) % 128},
                            {std::max(ring - 1, 0), part},
                            {std::min(ring + 1, 15), part}};
    std::set<Cell> found;
    for (const std::size_t other : neighbors()[i])
      found.insert(cell_of(gather_directions()[other]));
    EXPECT_EQ(found, expected) << i;
  }
}

}  // namespace
}  // namespace angen::light

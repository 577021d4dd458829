#include "rviz/glow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace angen::node {
namespace {

/// The greatest alpha on the floor, and on the wall at the greatest y.
std::pair<float, float> strongest(const visualization_msgs::Marker& glow, double floor) {
  std::pair<float, float> found{0.0F, 0.0F};
  for (std::size_t i = 0; i < glow.points.size(); ++i) {
    const bool low = glow.points[i].z < floor + 0.03;
    float& part = low ? found.first : found.second;
    part = std::max(part, glow.colors[i].a);
  }
  return found;
}

/// L-shaped, 4 x 3 m without its upper right quarter.
Room corner_room(double floor) {
  Room room;
  room.outline = {{0, 0}, {4, 0}, {4, 1.5}, {2, 1.5}, {2, 3}, {0, 3}};
  room.floor = floor;
  room.ceiling = floor + 2.5;
  return room;
}

TEST(Glow, GrowsWithTheLampsLevelOnFloorAndWalls) {
  Room room = corner_room(0.0);
  room.outline = {{0, 0}, {4, 0}, {4, 3}, {0, 3}};
  const Vec3 lamp(2.0, 1.5, 2.2);
  const auto dim = strongest(draw_glow(room, lit_faces(room), lamp, {}, 0.1), -2.2);
  const auto full = strongest(draw_glow(room, lit_faces(room), lamp, {}, 1.0), -2.2);
  EXPECT_GT(dim.first, 0.0F);
  EXPECT_GT(full.first, 2 * dim.first);
  EXPECT_GT(full.second, 2 * dim.second);
}

TEST(Glow, LiesInTheRoom) {
  const Room room = corner_room(4.0);
  const Vec3 lamp(1.0, 1.0, 6.2);
  const visualization_msgs::Marker glow = draw_glow(room, lit_faces(room), lamp, {}, 1.0);
  ASSERT_EQ(glow.points.size(), glow.colors.size());
  double area = 0.0;  // of the floor that is lit
  for (std::size_t i = 0; i < glow.points.size(); i += 3) {
    Vec3 middle = lamp;
    std::vector<Vec3> corners;
    for (std::size_t k = i; k < i + 3; ++k) {
      corners.emplace_back(glow.points[k].x, glow.points[k].y, glow.points[k].z);
      middle += corners.back() / 3.0;
    }
    EXPECT_TRUE(room.at_height(middle.z()));
    const bool inside = room.contains(middle.head<2>());
    EXPECT_TRUE(inside || room.distance(middle.head<2>()) < 0.5) << middle.transpose();
    if (middle.z() < room.floor + 0.03) {
      area += (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm() / 2;
    }
  }
  EXPECT_NEAR(area, 9.0, 1.0);
}

}  // namespace
}  // namespace angen::node

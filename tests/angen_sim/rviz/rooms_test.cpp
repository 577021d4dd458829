#include "rviz/rooms.h"

#include <gtest/gtest.h>

#include "rviz/glow.h"
#include "rviz/marker_plan.h"

namespace angen::node {
namespace {

desc::Link box_link(const std::string& name, const Vec3& middle, const Vec3& size) {
  desc::Link link;
  link.name = name;
  link.pose.position = middle;
  desc::Visual visual;
  visual.shape.type = Shape::Type::kBox;
  visual.shape.size = size;
  link.visuals.push_back(visual);
  return link;
}

/// A kitchen of 4 m by 3 m on the storey whose floor is at z.
desc::Model house(double z) {
  desc::Model model;
  model.name = "house";
  model.is_static = true;
  model.pose.position.z() = z;
  model.links = {box_link("floor_kitchen", {2.0, 1.5, -0.1}, {4.1, 3.1, 0.2}),
                 box_link("floor_edge", {5.0, 1.5, -0.1}, {0.1, 2.0, 0.2}),
                 box_link("ceiling_kitchen", {2.0, 1.5, 2.55}, {4.1, 3.1, 0.1}),
                 box_link("wall_a", {2.0, 0.0, 1.5}, {4.1, 0.1, 3.0}),
                 box_link("wall_b", {2.0, 3.0, 1.5}, {4.1, 0.1, 3.0}),
                 box_link("wall_c", {0.0, 1.5, 1.5}, {0.1, 3.1, 3.0}),
                 box_link("wall_d", {5.0, 1.5, 1.5}, {0.1, 3.1, 3.0}),
                 box_link("wall_inside", {4.0, 1.5, 1.5}, {0.1, 3.1, 3.0})};
  for (int i = 0; i < 4; ++i) model.links.push_back(model.links.back());
  return model;
}

sim::Structure structure_of(const std::vector<desc::Model>& models) {
  sim::Structure structure;
  for (const desc::Model& model : models) {
    const auto index = static_cast<std::uint32_t>(structure.models.size());
    for (std::uint32_t i = 0; i < model.links.size(); ++i) {
      structure.links.push_back({model.links[i].name, index, i, !model.is_static});
    }
    structure.models.push_back(std::make_shared<const desc::Model>(model));
  }
  return structure;
}

TEST(Rooms, OneForEachFloorThatIsLargeEnough) {
  const std::vector<Room> rooms = find_rooms(structure_of({house(0.0), house(4.0)}));
  ASSERT_EQ(rooms.size(), 2U);
  EXPECT_EQ(rooms[0].name, "kitchen");
  EXPECT_EQ(rooms[0].storey, " 0");
  EXPECT_EQ(rooms[1].storey, " 1");
  EXPECT_LT((rooms[1].pose.position - Vec3(2.0, 1.5, 4.0)).norm(), 1e-9);
  EXPECT_LT((rooms[0].size - Vec3(4.0, 3.0, 2.5)).norm(), 1e-9);
}

TEST(Rooms, ContainPointsUpToTheirCeiling) {
  const std::vector<Room> rooms = find_rooms(structure_of({house(0.0), house(4.0)}));
  EXPECT_EQ(room_around(rooms, {1.0, 1.0, 2.0}), &rooms[0]);
  EXPECT_EQ(room_around(rooms, {1.0, 1.0, 6.0}), &rooms[1]);
  EXPECT_EQ(room_around(rooms, {1.0, 1.0, 3.0}), nullptr);
  EXPECT_EQ(room_around(rooms, {4.5, 1.0, 1.0}), nullptr);
}

TEST(Groups, OfABuildingHaveItsStoreyAndSide) {
  const sim::Structure structure = structure_of({house(4.0)});
  const std::vector<std::string> expected = {"floors 1",      "floors 1",      "ceilings 1",
                                             "walls south 1", "walls north 1", "walls west 1",
                                             "walls east 1",  "walls 1"};
  for (std::uint32_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(marker_group(structure, i), expected[i]);
  }
}

TEST(Groups, HaveTheStoreyOfTheirModelUnlessItTravels) {
  desc::Model chair;
  chair.pose.position.z() = 3.6;
  chair.links.push_back(box_link("link", Vec3::Zero(), Vec3::Ones()));
  sim::Structure structure = structure_of({chair, chair, chair, chair});
  structure.devices.push_back({{"door", "kitchen1", nullptr, ""}, 1});
  structure.devices.push_back({{"drive", "robot", nullptr, ""}, 2});
  structure.devices.push_back({{"person", "person", nullptr, ""}, 3});
  EXPECT_EQ(marker_group(structure, 0), "furniture 1");
  EXPECT_EQ(marker_group(structure, 1), "doors 1");
  EXPECT_EQ(marker_group(structure, 2), "robots");
  EXPECT_EQ(marker_group(structure, 3), "people");
}

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

TEST(Glow, GrowsWithTheLampsLevelOnFloorAndWalls) {
  const Room room = find_rooms(structure_of({house(0.0)})).front();
  const Vec3 lamp(2.0, 1.5, 2.2);
  const auto dim = strongest(draw_glow(room, lamp, {}, 0.1), -2.2);
  const auto full = strongest(draw_glow(room, lamp, {}, 1.0), -2.2);
  EXPECT_GT(dim.first, 0.0F);
  EXPECT_GT(full.first, 2 * dim.first);
  EXPECT_GT(full.second, 2 * dim.second);
}

TEST(Glow, LiesInTheRoom) {
  const std::vector<Room> rooms = find_rooms(structure_of({house(4.0)}));
  const Vec3 lamp(1.0, 1.0, 6.2);
  const visualization_msgs::Marker glow = draw_glow(rooms.front(), lamp, {}, 1.0);
  ASSERT_EQ(glow.points.size(), glow.colors.size());
  for (const geometry_msgs::Point& p : glow.points) {
    EXPECT_NE(room_around(rooms, lamp + Vec3(p.x, p.y, p.z)), nullptr);
  }
}

}  // namespace
}  // namespace angen::node

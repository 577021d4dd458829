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

/// Of a world with storeys at 0 and 4 m.
sim::Structure structure_of(const std::vector<desc::Model>& models) {
  sim::Structure structure;
  structure.storeys = {{0, "", 0.0, 4.0}, {1, "", 4.0, 4.0}};
  for (const desc::Model& model : models) {
    const auto index = static_cast<std::uint32_t>(structure.models.size());
    for (std::uint32_t i = 0; i < model.links.size(); ++i) {
      structure.links.push_back({model.links[i].name, index, i, !model.is_static});
    }
    structure.models.push_back(std::make_shared<const desc::Model>(model));
  }
  return structure;
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

TEST(Groups, OfAWindowHaveTheSideOfTheWallThatItIsIn) {
  desc::Model window;
  window.links.push_back(box_link("pane", {0.5, 0.03, 0.5}, {1.0, 0.02, 1.0}));
  std::vector<desc::Model> models{house(4.0)};
  for (const Vec3& place : {Vec3(1, 0, 5), Vec3(1, 2.97, 5), Vec3(1, 1.5, 5), Vec3(1, 0, 1)}) {
    models.push_back(window);
    models.back().pose.position = place;
  }
  sim::Structure structure = structure_of(models);
  for (std::uint32_t i = 1; i < models.size(); ++i) {
    structure.devices.push_back({{"window", "w", nullptr, ""}, i});
  }
  const auto first = static_cast<std::uint32_t>(models[0].links.size());
  EXPECT_EQ(marker_group(structure, first), "windows south 1");
  EXPECT_EQ(marker_group(structure, first + 1), "windows north 1");
  EXPECT_EQ(marker_group(structure, first + 2), "windows 1");
  EXPECT_EQ(marker_group(structure, first + 3), "windows 0");  // of no building
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

/// L-shaped, 4 x 3 m without its upper right quarter.
Room corner_room(double floor) {
  Room room;
  room.outline = {{0, 0}, {4, 0}, {4, 1.5}, {2, 1.5}, {2, 3}, {0, 3}};
  room.floor = floor;
  room.ceiling = floor + 2.5;
  return room;
}

TEST(Storey, OfAModelIsByTheStoreysThatTheWorldDescribes) {
  sim::Structure structure = structure_of({house(0.0)});
  EXPECT_EQ(storey_suffix(structure, 0, 3.0), " 0");
  structure.storeys = {{-1, "", -2.6, 2.6}, {0, "", 0.0, 2.9}, {1, "", 2.9, 2.6}};
  EXPECT_EQ(storey_suffix(structure, 0, 3.0), " 1");
  EXPECT_EQ(storey_suffix(structure, 0, -2.0), " -1");
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

TEST(Groups, OfASurfaceHaveTheSideOfTheOutermostWallThatItIsOn) {
  const sim::Structure structure = structure_of({house(4.0)});
  const auto side = [&](const Vec3& low, const Vec3& high) {
    return outer_side(structure, Eigen::AlignedBox3d(low, high));
  };
  EXPECT_EQ(side({0.1, 0.07, 4.0}, {3.9, 0.07, 6.8}), "south");
  EXPECT_EQ(side({0.1, 2.93, 4.0}, {3.9, 2.93, 6.8}), "north");
  EXPECT_EQ(side({3.93, 0.1, 4.0}, {3.93, 2.9, 6.8}), "");  // of an inner wall
  EXPECT_EQ(side({0.1, 0.1, 4.02}, {3.9, 2.9, 4.02}), "");  // the floor
  EXPECT_EQ(side({0.1, 0.07, 0.0}, {3.9, 0.07, 2.8}), "");  // below the building
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

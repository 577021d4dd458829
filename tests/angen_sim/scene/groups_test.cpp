#include "scene/groups.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "plugin/library.h"

namespace angen::scene {
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

/// A device of one of Angen's own kinds.
sim::DeviceEntry device_of(const std::string& kind, std::uint32_t model) {
  static Catalog catalog;
  static const std::vector<std::shared_ptr<const Plugin>> own = catalog.own();
  const auto found = std::find_if(own.begin(), own.end(),
                                  [&](const auto& plugin) { return plugin->kind().name == kind; });
  EXPECT_NE(found, own.end()) << kind;
  return {{kind, "it", *found, ""}, model};
}

TEST(Groups, OfABuildingHaveItsStoreyAndSide) {
  const sim::Structure structure = structure_of({house(4.0)});
  const std::vector<std::string> expected = {"floors 1",      "floors 1",      "ceilings 1",
                                             "walls south 1", "walls north 1", "walls west 1",
                                             "walls east 1",  "walls 1"};
  for (std::uint32_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(group_of(structure, i), expected[i]);
  }
}

TEST(Groups, OfAModelWithRoomsAreThoseOfABuilding) {
  desc::Model room = house(4.0);
  room.links.erase(room.links.begin() + 3, room.links.end());
  EXPECT_EQ(group_of(structure_of({room}), 2), "furniture 1");
  room.home.rooms.emplace_back();
  EXPECT_EQ(group_of(structure_of({room}), 2), "ceilings 1");
}

TEST(Groups, HaveTheStoreyOfTheirModelUnlessItTravels) {
  desc::Model chair;
  chair.pose.position.z() = 3.6;
  chair.links.push_back(box_link("link", Vec3::Zero(), Vec3::Ones()));
  sim::Structure structure = structure_of({chair, chair, chair, chair, chair});
  structure.devices.push_back(device_of("tag", 0));  // a part of it
  structure.devices.push_back(device_of("door", 1));
  structure.devices.push_back(device_of("battery", 2));
  structure.devices.push_back(device_of("drive", 2));
  structure.devices.push_back(device_of("person", 3));
  structure.devices.push_back(device_of("elevator", 4));
  EXPECT_EQ(group_of(structure, 0), "furniture 1");
  EXPECT_EQ(group_of(structure, 1), "doors 1");
  EXPECT_EQ(group_of(structure, 2), "robots");
  EXPECT_EQ(group_of(structure, 3), "people");
  EXPECT_EQ(group_of(structure, 4), "elevators");
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
    structure.devices.push_back(device_of("window", i));
  }
  const auto first = static_cast<std::uint32_t>(models[0].links.size());
  EXPECT_EQ(group_of(structure, first), "windows south 1");
  EXPECT_EQ(group_of(structure, first + 1), "windows north 1");
  EXPECT_EQ(group_of(structure, first + 2), "windows 1");
  EXPECT_EQ(group_of(structure, first + 3), "windows 0");  // it belongs to no building
}

TEST(Storey, OfAModelIsByTheStoreysThatTheWorldDescribes) {
  sim::Structure structure = structure_of({house(0.0)});
  EXPECT_EQ(storey_suffix(structure, 0, 3.0), " 0");
  structure.storeys = {{-1, "", -2.6, 2.6}, {0, "", 0.0, 2.9}, {1, "", 2.9, 2.6}};
  EXPECT_EQ(storey_suffix(structure, 0, 3.0), " 1");
  EXPECT_EQ(storey_suffix(structure, 0, -2.0), " -1");
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

}  // namespace
}  // namespace angen::scene

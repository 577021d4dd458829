#include "ros/frames.h"

#include <gtest/gtest.h>

#include <map>

namespace angen::node {
namespace {

desc::Link link(const std::string& name, double x = 0.0) {
  desc::Link made;
  made.name = name;
  made.pose.position.x() = x;
  return made;
}

desc::Joint joint(desc::Joint::Type type, const std::string& parent, const std::string& child) {
  desc::Joint made;
  made.name = parent + "_" + child;
  made.type = type;
  made.parent = parent;
  made.child = child;
  return made;
}

desc::Model door() {
  desc::Model model;
  model.name = "door";
  model.links = {link("base"), link("leaf", 0.1), link("handle", 0.8)};
  model.joints = {joint(desc::Joint::Type::kFixed, "world", "base"),
                  joint(desc::Joint::Type::kRevolute, "base", "leaf"),
                  joint(desc::Joint::Type::kFixed, "leaf", "handle")};
  return model;
}

desc::Model robot(const std::string& name) {
  desc::Model model;
  model.name = name;
  model.pose.position = {3.0, 0.0, 0.0};
  model.links = {link("base_footprint"), link("left_wheel", 0.1), link("camera", 0.2)};
  model.joints = {joint(desc::Joint::Type::kRevolute, "base_footprint", "left_wheel"),
                  joint(desc::Joint::Type::kFixed, "base_footprint", "camera")};
  return model;
}

/// A snapshot of these models where their descriptions put them.
struct World {
  sim::Snapshot snapshot;
  std::shared_ptr<sim::Structure> structure = std::make_shared<sim::Structure>();

  void add(const desc::Model& model, const std::string& device = "") {
    const auto index = static_cast<std::uint32_t>(structure->models.size());
    for (std::uint32_t i = 0; i < model.links.size(); ++i) {
      structure->links.push_back(
          {model.name + "::" + model.links[i].name, index, i, !model.is_static});
      snapshot.link_poses.push_back(model.pose * model.links[i].pose);
    }
    if (!device.empty()) structure->devices.push_back({{device, model.name, nullptr, ""}, index});
    structure->models.push_back(std::make_shared<const desc::Model>(model));
    snapshot.structure = structure;
  }
  void add_sensor(const std::string& name, std::uint32_t on, const std::string& frame = "") {
    sim::SensorEntry entry;
    entry.kind = "pir";
    entry.name = name;
    entry.link = on;
    entry.frame = frame;
    structure->sensors.push_back(entry);
  }
  FrameTree tree() const { return make_frames(snapshot, find_robots(*structure, {})); }
};

std::map<std::string, std::string> parents(const FrameTree& tree) {
  std::map<std::string, std::string> found;
  for (const FixedFrame& frame : tree.fixed) found[frame.child] = "fixed " + frame.parent;
  for (const MovingFrame& frame : tree.moving) found[frame.child] = "moving " + frame.parent;
  return found;
}

using Tree = std::map<std::string, std::string>;

TEST(Frames, OnlyWhatCanMoveHangsOnAMovingFrame) {
  World world;
  world.add(door());
  const FrameTree tree = world.tree();
  EXPECT_EQ(parents(tree), (Tree{{"door/base", "fixed world"},
                                 {"door/leaf", "moving world"},
                                 {"door/handle", "fixed door/leaf"}}));
  EXPECT_EQ(tree.moved_by, (std::vector<std::int32_t>{-1, 0, 0}));
}

TEST(Frames, ARigidPartKeepsItsPlaceOnItsHead) {
  World world;
  world.add(door());
  const FrameTree tree = world.tree();
  ASSERT_EQ(tree.fixed.back().child, "door/handle");
  EXPECT_NEAR(tree.fixed.back().pose.position.x(), 0.7, 1e-12);
}

TEST(Frames, StaticModelsStandInTheWorld) {
  desc::Model flat;
  flat.name = "flat";
  flat.is_static = true;
  flat.links = {link("wall", 2.0)};
  World world;
  world.add(flat);
  EXPECT_EQ(parents(world.tree()), (Tree{{"flat/wall", "fixed world"}}));
}

TEST(Frames, TheFirstRobotHasTheUsualNames) {
  World world;
  world.add(robot("turtlebot"), "drive");
  const FrameTree tree = world.tree();
  EXPECT_EQ(parents(tree), (Tree{{"odom", "fixed world"},
                                 {"turtlebot/left_wheel", "moving base_footprint"},
                                 {"turtlebot/camera", "fixed base_footprint"}}));
  EXPECT_EQ(tree.fixed.back().pose.position.x(), 3.0);
}

TEST(Frames, ACamerasFrameLooksAlongItsZ) {
  World world;
  world.add(door());
  world.add_sensor("eye", 0);
  world.structure->sensors.back().kind = "camera";
  const FrameTree tree = world.tree();
  EXPECT_EQ(tree.sensors.back(), "eye_optical_frame");
  const Quat& optical = tree.fixed.back().pose.rotation;
  EXPECT_LT((optical * Vec3::UnitZ() - Vec3::UnitX()).norm(), 1e-12);  // ahead
  EXPECT_LT((optical * Vec3::UnitX() + Vec3::UnitY()).norm(), 1e-12);  // right
  EXPECT_LT((optical * Vec3::UnitY() + Vec3::UnitZ()).norm(), 1e-12);  // down
}

TEST(Frames, FurtherRobotsHaveTheirNamesInFront) {
  World world;
  world.add(robot("first"), "drive");
  world.add(robot("second"), "drive");
  const std::vector<Robot> robots = find_robots(*world.structure, {});
  ASSERT_EQ(robots.size(), 2U);
  EXPECT_EQ(robots[0].command_topics, (std::vector<std::string>{"/first/cmd_vel", "/cmd_vel"}));
  EXPECT_EQ(robots[1].command_topics, std::vector<std::string>{"/second/cmd_vel"});
  EXPECT_EQ(robots[1].odometry_topics, std::vector<std::string>{"/second/odom"});
  EXPECT_EQ(parents(world.tree())["second/odom"], "fixed world");
  EXPECT_EQ(parents(world.tree())["second/camera"], "fixed second/base_footprint");
}

TEST(Frames, SensorsHangOnTheirLinks) {
  World world;
  world.add(door());
  world.add_sensor("p1", 1);
  world.add_sensor("p2", 1, "eye");
  world.add_sensor("eye", 0);  // its name is taken
  const FrameTree tree = world.tree();
  EXPECT_EQ(tree.sensors, (std::vector<std::string>{"p1", "eye", "pir_eye"}));
  EXPECT_EQ(parents(tree)["eye"], "fixed door/leaf");
  EXPECT_EQ(parents(tree)["pir_eye"], "fixed door/base");
}

}  // namespace
}  // namespace angen::node

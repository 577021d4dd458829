#include "tf/frames.h"

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
  void add_sensor(const std::string& name, std::uint32_t on, const std::string& frame = "",
                  const std::string& kind = "pir") {
    sim::SensorEntry entry;
    entry.kind = kind;
    entry.name = name;
    entry.link = on;
    entry.frame = frame;
    structure->sensors.push_back(entry);
  }
  FrameTree tree() const {
    const Changes changes = changes_between(nullptr, *structure);
    return *FrameMaker().make(snapshot, find_robots(*structure, {}), changes);
  }
};

std::vector<FixedFrame> all_fixed(const FrameTree& tree) {
  std::vector<FixedFrame> all(tree.fixed.begin(), tree.fixed.end());
  all.insert(all.end(), tree.odometry.begin(), tree.odometry.end());
  all.insert(all.end(), tree.mounts.begin(), tree.mounts.end());
  return all;
}

std::vector<std::string> sensor_frames(const FrameTree& tree) {
  return {tree.sensors.begin(), tree.sensors.end()};
}

std::map<std::string, std::string> parents(const FrameTree& tree) {
  std::map<std::string, std::string> found;
  for (const FixedFrame& frame : all_fixed(tree)) found[frame.child] = "fixed " + frame.parent;
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
  EXPECT_EQ(std::vector<std::int32_t>(tree.moved_by.begin(), tree.moved_by.end()),
            (std::vector<std::int32_t>{-1, 0, 0}));
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
  EXPECT_EQ(tree.odometry.back().pose.position.x(), 3.0);
}

TEST(Frames, ACamerasFrameLooksAlongItsZ) {
  World world;
  world.add(door());
  world.add_sensor("eye", 0, "", "camera");
  const FrameTree tree = world.tree();
  EXPECT_EQ(tree.sensors.back(), "eye_optical_frame");
  const Quat& optical = tree.mounts.back().pose.rotation;
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
  EXPECT_EQ(sensor_frames(tree), (std::vector<std::string>{"p1", "eye", "pir_eye"}));
  EXPECT_EQ(parents(tree)["eye"], "fixed door/leaf");
  EXPECT_EQ(parents(tree)["pir_eye"], "fixed door/base");
}

/// The names of a world's sensors.
enum class Names { kTwice, kOnce, kAsALink };

std::string sensor_name(Names names, const World& world) {
  const std::string& model = world.structure->models.back()->name;
  if (names == Names::kTwice) return "eye" + std::to_string(world.structure->sensors.size() % 2);
  return names == Names::kAsALink && model == "door0" ? "second/base_footprint" : "eye_" + model;
}

/// The world of some models, which are shared with other worlds, with a sensor each.
World world_of(const std::vector<std::shared_ptr<const desc::Model>>& models, Names names) {
  World world;
  world.snapshot.structure = world.structure;
  for (const auto& model : models) {
    world.add(*model, model->links.size() == 3 && model->name != "door" ? "drive" : "");
    world.structure->models.back() = model;
    world.add_sensor(sensor_name(names, world),
                     static_cast<std::uint32_t>(world.structure->links.size() - 1));
    sim::SensorEntry sensor = world.structure->sensors.back();
    sensor.model = world.structure->links.back().model;
    sensor.desc = {model, &model->links.front().sensors.front()};
    world.structure->sensors.set(world.structure->sensors.size() - 1, sensor);
  }
  return world;
}

std::string text_of(const FrameTree& tree) {
  std::string text;
  for (const FixedFrame& frame : all_fixed(tree)) {
    text +=
        frame.parent + " > " + frame.child + " " + std::to_string(frame.pose.position.x()) + ";";
  }
  for (const MovingFrame& frame : tree.moving) {
    text += frame.parent + " > " + frame.child + " " + std::to_string(frame.link) + " " +
            std::to_string(frame.parent_link.value_or(99)) + ";";
  }
  for (const std::string& frame : tree.sensors) text += frame + ";";
  for (const std::int32_t by : tree.moved_by) text += std::to_string(by) + ";";
  return text;
}

void expect_as_made_anew(Names names) {
  std::vector<std::shared_ptr<const desc::Model>> all;
  for (desc::Model model : {door(), robot("first"), robot("second"), door(), robot("third")}) {
    if (model.name == "door") model.name += std::to_string(all.size());
    model.links.front().sensors.resize(1);
    all.push_back(std::make_shared<const desc::Model>(model));
  }
  using Kept = std::vector<std::size_t>;
  FrameMaker maker;
  std::shared_ptr<const sim::Structure> before;
  for (const Kept& kept : {Kept{0, 1, 2, 3, 4}, Kept{0, 2, 3, 4}, Kept{0, 2, 4}, Kept{0, 2, 4, 1},
                           Kept{0, 2}, Kept{0}, Kept{0, 4}, Kept{0, 4, 2}, Kept{0, 4}, Kept{4, 1},
                           Kept{}, Kept{3, 1}, Kept{3, 1, 0}, Kept{1, 0}}) {
    std::vector<std::shared_ptr<const desc::Model>> models;
    for (const std::size_t i : kept) models.push_back(all[i]);
    const World world = world_of(models, names);
    const Changes changes = changes_between(before.get(), *world.structure);
    const auto robots = find_robots(*world.structure, {});
    EXPECT_EQ(text_of(*maker.make(world.snapshot, robots, changes)), text_of(world.tree()));
    before = world.structure;
  }
}

TEST(Frames, OfModelsThatStayAreThoseOfATreeMadeAnew) {
  expect_as_made_anew(Names::kTwice);
  expect_as_made_anew(Names::kOnce);
  expect_as_made_anew(Names::kAsALink);
}

// A robot of others in a namespace: two sensors on its first link.
World two_eyes(bool is_foreign) {
  World world;
  desc::Model model = robot("bot");
  model.customs.keeps_frames = is_foreign;
  model.plugins.resize(1);
  Element space;
  space.name = "robotNamespace";
  space.text = "/west";
  model.plugins[0].element.children = {space};
  world.add(model);
  world.add_sensor("scanner", 0, "base_scan");
  world.add_sensor("eye", 0, "/eye_link");
  return world;
}

TEST(Frames, OfARobotMadeForGazeboHaveItsPrefix) {
  std::string asked;
  FrameMaker maker(true, [&](const std::string& space) {
    asked = space;
    return "/west";
  });
  const World world = two_eyes(true);
  const auto tree = maker.make(world.snapshot, {}, changes_between(nullptr, *world.structure));
  EXPECT_EQ(asked, "/west");
  EXPECT_EQ(sensor_frames(*tree), (std::vector<std::string>{"west/base_scan", "eye_link"}));
  const auto again =
      maker.make(world.snapshot, {}, changes_between(world.structure.get(), *world.structure));
  EXPECT_EQ(sensor_frames(*again), sensor_frames(*tree)) << "it stays with a robot that stays";
}

TEST(Frames, NoneBeginsWithASlash) {
  const World world = two_eyes(true);
  EXPECT_EQ(sensor_frames(world.tree()), (std::vector<std::string>{"base_scan", "eye_link"}));
}

TEST(Frames, OfOurOwnModelsHaveNoPrefix) {
  FrameMaker maker(true, [](const std::string&) { return "west"; });
  const World world = two_eyes(false);
  const auto tree = maker.make(world.snapshot, {}, changes_between(nullptr, *world.structure));
  EXPECT_EQ(tree->sensors[0], "base_scan");
}

}  // namespace
}  // namespace angen::node

#include <gtest/gtest.h>

#include <map>

#include "home/survey.h"

namespace angen {
namespace {

desc::Room room(const std::string& name, double x0, double y0, double x1, double y1) {
  desc::Room made;
  made.name = name;
  made.outline = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  return made;
}

void add(HomeSurvey& survey, desc::Model model) {
  const Pose pose = model.pose;
  survey.models.push_back({std::make_shared<const desc::Model>(std::move(model)), pose});
  std::vector<std::pair<const desc::Model*, Pose>> models;
  for (const auto& each : survey.models) models.emplace_back(each.model.get(), each.pose);
  survey.storeys = storeys_of(survey.parts, models);
}

desc::Link leaf_link(const std::string& name, const Vec3& middle, const Vec3& size) {
  desc::Link link;
  link.name = name;
  link.pose.position = middle;
  desc::Collision collision;
  collision.shape.type = Shape::Type::kBox;
  collision.shape.size = size;
  link.collisions.push_back(collision);
  return link;
}

/// Leaves of 0.9 m on hinges at x of the model, that extend in its +x or -x.
desc::Model door(const Pose& pose, const std::vector<std::pair<double, double>>& leaves) {
  desc::Model model;
  model.name = "door";
  model.pose = pose;
  for (const auto& [x, way] : leaves) {
    const std::string number = std::to_string(model.links.size());
    model.links.push_back(
        leaf_link("leaf" + number, {x + 0.45 * way, 0.02, 1.005}, {0.9, 0.04, 2.0}));
    desc::Joint joint;
    joint.name = "hinge" + number;
    joint.child = "leaf" + number;
    joint.anchor = {x, 0.0, 0.0};
    model.joints.push_back(joint);
  }
  return model;
}

Pose at(double x, double y, double z, double yaw) { return {{x, y, z}, from_rpy(0, 0, yaw)}; }

TEST(Derive, ADoorOnTheFaceOfAThickWallJoinsTheRoomsOnBothSides) {
  // A wall of 0.4 m whose middle is the edge of both rooms; the leaf is on either face.
  for (const double y : {2.8, 3.16}) {
    HomeSurvey survey;
    survey.parts.rooms = {room("south", 0, 0, 4, 3), room("north", 0, 3, 4, 6)};
    add(survey, door(at(1.0, y, 0.0, 0.0), {{0.0, 1.0}}));
    survey.leaves = {{0, "hinge0", "d", HomeDoor::Kind::kDoor}};
    const Home home = derive_home(survey);
    ASSERT_EQ(home.doors.size(), 1U);
    EXPECT_EQ(home.doors[0].rooms[0], "north") << y;
    EXPECT_EQ(home.doors[0].rooms[1], "south") << y;
    EXPECT_NEAR(home.doors[0].width, 0.9, 1e-9);
    EXPECT_NEAR(home.doors[0].height, 2.005, 1e-9);
    EXPECT_NEAR(home.doors[0].pose.position.x(), 1.45, 1e-9);
    EXPECT_EQ(home.doors[0].pose.position.z(), 0.0);
    EXPECT_TRUE(check_home(survey, home).size() == 4) << "entrance, north, latitude, start";
  }
}

TEST(Derive, TwoLeavesOfOneNameAreOneDoor) {
  HomeSurvey survey;
  survey.parts.rooms = {room("west", -4, 0, -0.05, 4), room("east", 0.05, 0, 4, 4)};
  add(survey, door(at(0.0, 1.0, 0.0, M_PI_2), {{0.0, 1.0}, {1.84, -1.0}}));
  survey.leaves = {{0, "hinge0", "d", HomeDoor::Kind::kDoor},
                   {0, "hinge1", "d", HomeDoor::Kind::kDoor}};
  const Home home = derive_home(survey);
  ASSERT_EQ(home.doors.size(), 1U);
  EXPECT_NEAR(home.doors[0].width, 1.84, 1e-9);
  EXPECT_NEAR(home.doors[0].pose.position.y(), 1.92, 1e-9);
  EXPECT_EQ(home.doors[0].rooms[0], "west");
  EXPECT_EQ(home.doors[0].rooms[1], "east");
}

TEST(Derive, LeavesWhoseEdgesMeetArePartners) {
  HomeSurvey survey;
  survey.parts.rooms = {room("west", -4, 0, -0.05, 8), room("east", 0.05, 0, 4, 8)};
  const auto leaf = [](int number, const char* name) {
    return HomeSurvey::Leaf{0, "hinge" + std::to_string(number), name, HomeDoor::Kind::kDoor};
  };
  // The hinge of the third is beside that of the second; the last two slide.
  desc::Model model = door(at(0.0, 1.0, 0.0, M_PI_2),
                           {{0.0, 1.0}, {1.84, -1.0}, {1.9, 1.0}, {4.0, 1.0}, {4.95, 1.0}});
  for (const std::size_t i : {3, 4}) {
    model.joints[i].type = desc::Joint::Type::kPrismatic;
    model.joints[i].anchor.x() += 0.45;
  }
  add(survey, std::move(model));
  survey.leaves = {leaf(0, "left"), leaf(1, "right"), leaf(2, "alone"), leaf(3, "one"),
                   leaf(4, "two")};
  std::map<std::string, std::string> partners;
  for (const HomeDoor& each : derive_home(survey).doors) partners[each.name] = each.partner;
  EXPECT_EQ(
      partners,
      (std::map<std::string, std::string>{
          {"left", "right"}, {"right", "left"}, {"alone", ""}, {"one", "two"}, {"two", "one"}}));
}

TEST(Derive, WhatHasOneNameTwiceIsSaid) {
  HomeSurvey survey;
  survey.parts.rooms = {room("hall", 0, 0, 4, 3), room("hall", 0, 3, 4, 6)};
  survey.parts.storeys = {{"Ground", 0, 0.0, {}, {}}, {"Ground", 1, 3.0, {}, {}}};
  for (const double x : {1.0, 3.0}) {
    survey.parts.openings.push_back({"arch", {{x, 3.0, 0.0}, 0.0}, 0.9, 2.1, {}});
  }
  add(survey, door(at(1.0, 0.0, 0.0, 0.0), {{0.0, 1.0}}));
  std::string said;
  for (const HomeFinding& each : check_home(survey, derive_home(survey))) said += each.text + "\n";
  for (const char* what : {"two rooms are named 'hall'", "two storeys are named 'Ground'",
                           "two doors or openings are named 'arch'"}) {
    EXPECT_NE(said.find(what), std::string::npos) << what << "\n" << said;
  }
}

TEST(Derive, StoreysFollowFromFloorsOrAreGiven) {
  HomeSurvey survey;
  for (const double z : {-2.6, 0.0, 2.9}) {
    desc::Model level;
    level.name = "level" + std::to_string(survey.models.size());
    level.pose.position.z() = z;
    level.home.rooms = {room("hall{storey}", 0, 0, 4, 3), room("step{storey}", 4, 0, 5, 3)};
    level.home.rooms[1].floor = 0.4;
    add(survey, level);
  }
  Home home = derive_home(survey);
  ASSERT_EQ(home.storeys.size(), 3U);
  EXPECT_EQ(home.rooms[0].name, "hall0");
  EXPECT_EQ(home.rooms[5].name, "step2");
  EXPECT_NEAR(home.storeys[0].height, 2.6, 1e-9);
  survey.storeys = {{-1, "Cellar", -2.6, 2.3}, {0, "Ground", 0.0, 0.0}, {1, "", 2.9, 0.0}};
  home = derive_home(survey);
  EXPECT_EQ(home.rooms[0].name, "hall-1");
  EXPECT_EQ(home.rooms[5].storey, 1);
  EXPECT_EQ(home.storeys[0].height, 2.3);
  EXPECT_NEAR(home.storeys[1].height, 2.9, 1e-9);
}

TEST(Derive, AnElevatorHasALandingForEachStopAtAStorey) {
  HomeSurvey survey;
  for (const double z : {0.0, 3.0}) {
    desc::Model level;
    level.pose.position.z() = z;
    level.home.rooms = {room("landing{storey}", 1, -2, 4, 2), room("far{storey}", -9, -2, -4, 2)};
    add(survey, level);
  }
  desc::Model lift;
  lift.pose.position = {-0.1, 0.3, 0.0};
  lift.links.push_back(leaf_link("cabin", {0, 0, 0}, {1.4, 1.4, 2.2}));
  desc::Joint joint;
  joint.name = "lift";
  joint.child = "cabin";
  lift.joints.push_back(joint);
  add(survey, lift);
  survey.lifts = {{2, "lift", "elevator", {0.0, 1.5, 3.0}}};
  const Home home = derive_home(survey);
  ASSERT_EQ(home.elevators.size(), 1U);
  const std::vector<Landing>& landings = home.elevators[0].landings;
  ASSERT_EQ(landings.size(), 2U);
  EXPECT_EQ(landings[1].room, "landing1");
  EXPECT_NEAR(landings[1].pose.position.x(), 1.9, 0.06);
  EXPECT_NEAR(landings[1].pose.position.y(), 0.3, 1e-9);
  EXPECT_NEAR(std::abs(landings[1].pose.yaw), M_PI, 1e-9);
}

TEST(Derive, ARoomHasItsAreaWithoutItsHolesAndIsNotEnteredThere) {
  HomeSurvey survey;
  survey.parts.rooms = {room("round", 0, 0, 10, 10)};
  survey.parts.rooms[0].holes = {{{4, 4}, {6, 4}, {6, 6}, {4, 6}}};
  survey.storeys = storeys_of(survey.parts, {});
  const Home home = derive_home(survey);
  EXPECT_DOUBLE_EQ(home.rooms[0].area, 96.0);
  EXPECT_EQ(home.room_name_at({5, 5, 1}), "");
  EXPECT_EQ(home.room_name_at({4.05, 5, 1}), "round");  // in its wall
  EXPECT_EQ(home.room_name_at({2, 2, 4}), "");
}

}  // namespace
}  // namespace angen

#include "sim/edit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "angen_sim/sim/household.h"

namespace angen::sim {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const std::string kFree = R"(<model name='free'><pose>0 0 5 0 0 0</pose><link name='body'>
  <gravity>false</gravity><inertial><pose>0.1 0 0 0 0 0</pose><mass>2</mass><inertia><ixx>0.4</ixx>
  <iyy>0.4</iyy><izz>0.4</izz></inertia></inertial></link></model>)";
const std::string kSlide = R"(<model name='slide'><pose>0 5 1 0 0 0</pose>
  <link name='rail'/><link name='car'><gravity>false</gravity><inertial><mass>4</mass></inertial>
  </link><joint name='fix' type='fixed'><parent>world</parent><child>rail</child></joint>
  <joint name='along' type='prismatic'><parent>rail</parent><child>car</child><axis>
  <xyz>1 0 0</xyz><limit><lower>-3</lower><upper>3</upper></limit></axis></joint></model>)";

std::unique_ptr<Simulation> world_of(const std::string& models) {
  return simulation_of(in_world(models));
}

StateIn still(const Pose& pose, const std::string& frame = "") {
  return {frame, pose, Vec3::Zero(), Vec3::Zero()};
}

class Edits : public ::testing::Test {
 protected:
  Outcome post(Action action) {
    std::future<Outcome> answer = world_->post(std::move(action));
    world_->tick();
    return answer.get();
  }
  Outcome edit(Edit what) { return post(Action(std::move(what))); }
  Observed see(const std::string& entity, const std::string& joint = "") {
    const auto observed = std::make_shared<Observed>();
    Observation what;
    what.entities = {entity};
    if (!joint.empty()) what.joints = {joint};
    EXPECT_TRUE(post(Observe{what, observed}).ok);
    return *observed;
  }
  void pause() { post(Pause{true}); }
  void step(std::uint64_t ticks) {
    world_->post(Step{ticks});
    for (std::uint64_t i = 0; i < ticks; ++i) world_->tick();
  }

  std::unique_ptr<Simulation> world_ = world_of(kFree + kSlide + room_parts());

  static std::string room_parts() {
    return body("floor", "<box><size>20 20 0.2</size></box>", "0 0 -0.1 0 0 0", true) +
           body("post", "<box><size>0.2 0.2 0.2</size></box>", "3 3 1 0 0 1", true) +
           body("brick", "<box><size>0.2 0.2 0.2</size></box>", "-3 -3 0.1 0 0 0", false);
  }
};

TEST_F(Edits, AForceGivesItsImpulseForExactlyItsDuration) {
  pause();
  PushLink push{"free::body", "", Vec3::Zero(), {3, 0, 0}, Vec3::Zero(), {0, from_seconds(0.25)}};
  ASSERT_TRUE(edit(push).ok);
  step(1000);
  const Motion motion = see("free").entities[0];
  EXPECT_NEAR(motion.linear.x(), 3.0 / 2.0 * 0.25, 1e-12);
  EXPECT_LT(motion.angular.norm(), 1e-12);  // it acts at the center of mass
}

TEST_F(Edits, ATorqueTurnsAndAPointGivesTheForceAnArm) {
  pause();
  PushLink push{"free::body", "", {0, 0.5, 0}, {0, 0, 4}, {0, 0, 1}, {0, from_seconds(0.01)}};
  ASSERT_TRUE(edit(push).ok);
  step(20);
  const Vec3 spin = see("free").entities[0].angular;  // I = 0.4 about the center
  EXPECT_NEAR(spin.x(), 0.5 * 4 / 0.4 * 0.01, 1e-4);
  EXPECT_NEAR(spin.z(), 1.0 / 0.4 * 0.01, 1e-4);
}

TEST_F(Edits, AForceInAFrameHasItsAxesAndItsArm) {
  pause();
  PushLink push{"free::body", "post",       Vec3::Zero(),
                {2, 0, 0},    Vec3::Zero(), {0, from_seconds(0.001)}};
  ASSERT_TRUE(edit(push).ok);
  step(2);
  const Motion motion = see("free").entities[0];
  const Vec3 force(2 * std::cos(1.0), 2 * std::sin(1.0), 0);
  const Vec3 arm(3, 3, -4);  // of the frame, from the link's origin
  const Vec3 spin = arm.cross(force) / 0.4 * 0.001;
  const Vec3 center = motion.linear + motion.angular.cross(motion.pose.rotation * Vec3(0.1, 0, 0));
  EXPECT_LT((center - force / 2.0 * 0.001).norm(), 1e-9);
  EXPECT_LT((motion.angular - spin).norm(), 1e-4 * spin.norm());
}

TEST_F(Edits, AnEffortAcceleratesAJointUntilItIsCleared) {
  pause();
  ASSERT_TRUE(edit(PushJoint{"slide::along", 2.0, {from_seconds(0.1), -1}}).ok);
  step(100);
  EXPECT_EQ(see("slide", "slide::along").joints[0].velocity, 0.0);
  step(400);
  EXPECT_NEAR(see("slide", "slide::along").joints[0].velocity, 2.0 / 4.0 * 0.4, 1e-6);
  ASSERT_TRUE(edit(ClearPushes{"slide::along"}).ok);
  step(100);
  EXPECT_NEAR(see("slide", "slide::along").joints[0].velocity, 2.0 / 4.0 * 0.4, 1e-6);
}

TEST_F(Edits, APushShorterThanAStepTakesOneAndNoneTakesNone) {
  pause();
  PushLink push{"free::body", "", Vec3::Zero(), {2, 0, 0}, Vec3::Zero(), {123, 1000}};
  ASSERT_TRUE(edit(push).ok);
  push.time = {0, 0};
  ASSERT_TRUE(edit(push).ok);
  step(10);
  EXPECT_NEAR(see("free").entities[0].linear.x(), 2.0 / 2.0 * 0.001, 1e-12);
}

TEST_F(Edits, AStateIsReadBackWhileTimeStandsStill) {
  pause();
  const Pose pose{{1, 2, 3}, from_rpy(0.1, 0.2, 0.3)};
  ASSERT_TRUE(edit(SetModelState{"free", {"", pose, {1, 0, 0}, {0, 0, 2}}}).ok);
  const Motion motion = see("free").entities[0];
  EXPECT_LT((motion.pose.position - pose.position).norm(), 1e-12);
  EXPECT_LT(motion.pose.rotation.angularDistance(pose.rotation), 1e-7);
  EXPECT_LT((motion.linear - Vec3(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((motion.angular - Vec3(0, 0, 2)).norm(), 1e-12);
  const auto snapshot = world_->snapshot();
  for (std::size_t i = 0; i < snapshot->structure->links.size(); ++i) {
    if (snapshot->structure->links[i].name != "free::body") continue;
    EXPECT_LT((snapshot->link_poses[i].position - pose.position).norm(), 1e-12);
  }
}

TEST_F(Edits, AStateInAFrameIsTurnedWithIt) {
  pause();
  const Pose pose{{1, 0, 0}, Quat::Identity()};
  ASSERT_TRUE(edit(SetLinkState{"free::body", {"post::link", pose, {1, 0, 0}, Vec3::Zero()}}).ok);
  const Motion motion = see("free::body").entities[0];
  const Vec3 ahead(std::cos(1.0), std::sin(1.0), 0);
  EXPECT_LT((motion.pose.position - (Vec3(3, 3, 1) + ahead)).norm(), 1e-12);
  EXPECT_LT((motion.linear - ahead).norm(), 1e-12);
}

TEST_F(Edits, AModelInTheAirFallsAlsoWhereItSlept) {
  step(0);
  for (int i = 0; i < 1500; ++i) world_->tick();
  ASSERT_EQ(world_->snapshot()->counts.awake_bodies, 0U);
  ASSERT_TRUE(edit(SetModelState{"brick", still({{-3, -3, 2}, Quat::Identity()})}).ok);
  for (int i = 0; i < 300; ++i) world_->tick();
  EXPECT_NEAR(see("brick").entities[0].pose.position.z(), 2 - 0.5 * 9.8 * 0.09, 0.01);
}

TEST_F(Edits, JointsArePutWhereTheyAreWantedAndOthersStay) {
  pause();
  ASSERT_TRUE(edit(SetJoints{"slide", {"along"}, {1.25}}).ok);
  EXPECT_NEAR(see("slide", "slide::along").joints[0].position, 1.25, 1e-12);
  EXPECT_NEAR(see("slide::car").entities[0].pose.position.x(), 1.25, 1e-12);
  ASSERT_TRUE(edit(SetJoints{"slide", {}, {}}).ok);
  EXPECT_NEAR(see("slide", "slide::along").joints[0].position, 1.25, 1e-12);
}

TEST_F(Edits, PropertiesAreThoseOfTheStructureAndLastThroughAReset) {
  pause();
  SetLinkProperties to{"free::body", {}, true};
  to.inertial.mass = 5.0;
  ASSERT_TRUE(edit(to).ok);
  ASSERT_TRUE(edit(SetJointProperties{"slide::along", {8.0}, {0.5}, {}, {}, 0.0}).ok);
  ASSERT_TRUE(post(Reset{true}).ok);
  const auto structure = world_->snapshot()->structure;
  EXPECT_EQ(structure->models[0]->links[0].inertial.mass, 5.0);
  EXPECT_TRUE(structure->models[0]->links[0].gravity);
  EXPECT_EQ(structure->models[1]->joints[1].axes[0].damping, 8.0);
  EXPECT_EQ(structure->models[1]->joints[1].axes[0].upper, 0.5);
  EXPECT_EQ(structure->models[1]->joints[1].axes[0].lower, -3.0);
  ASSERT_TRUE(edit(SetJoints{"slide", {"along"}, {2.0}}).ok);
  EXPECT_NEAR(see("slide", "slide::along").joints[0].position, 0.5, 1e-9);
}

TEST_F(Edits, ADamperSlowsExponentially) {
  pause();
  ASSERT_TRUE(edit(SetJointProperties{"slide::along", {8.0}, {}, {}, {}, 0.0}).ok);
  ASSERT_TRUE(edit(PushJoint{"slide::along", 4000.0, {0, 1}}).ok);
  step(1);
  const double start = see("slide", "slide::along").joints[0].velocity;
  EXPECT_NEAR(start, 1.0, 0.01);
  step(500);
  EXPECT_NEAR(see("slide", "slide::along").joints[0].velocity / start, std::exp(-8.0 / 4.0 * 0.5),
              2e-3);
}

TEST_F(Edits, AMotorOfAJointHoldsItsSpeed) {
  pause();
  ASSERT_TRUE(edit(SetJointProperties{"slide::along", {}, {}, {}, 100.0, 0.5}).ok);
  step(1000);
  EXPECT_NEAR(see("slide", "slide::along").joints[0].velocity, 0.5, 1e-6);
}

TEST_F(Edits, AnotherGravityActsAndIsInTheStructure) {
  pause();
  SetPhysics to{world_->snapshot()->structure->physics, {0, 0, 1.5}};
  to.physics.iterations = 77;
  ASSERT_TRUE(edit(to).ok);
  step(1000);
  EXPECT_NEAR(see("brick").entities[0].linear.z(), 1.5, 0.01);
  EXPECT_EQ(world_->snapshot()->structure->gravity.z(), 1.5);
  EXPECT_EQ(world_->snapshot()->structure->physics.iterations, 77);
  EXPECT_EQ(world_->snapshot()->structure->physics.step, world_->snapshot()->step);
}

// An elevator, a sensor that does not move, and a crate of 5 kg on load cells.
std::unique_ptr<Simulation> world_of_weights() {
  const std::string felt = custom("felt", "accelerometer", "");
  const std::string crate =
      "<model name='crate'><pose>5 0 0.11 0 0 0</pose><link name='l'><inertial><mass>5</mass>"
      "<inertia><ixx>0.03</ixx><iyy>0.03</iyy><izz>0.03</izz></inertia></inertial><collision "
      "name='c'><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision><sensor "
      "name='s' type='contact'><contact><collision>c</collision></contact><plugin name='p' "
      "filename='libload_cells.so'/></sensor></link></model>";
  const std::string models =
      body("floor", "<box><size>2 2 0.2</size></box>", "5 0 -0.1 0 0 0", true) + crate +
      body("post", "<box><size>0.2 0.2 0.2</size></box>", "3 3 1 0 0 1", true, felt) +
      "<include><uri>model://elevator</uri></include>";
  return simulation_of(in_world(models), 0, std::make_shared<Catalog>(),
                       {{ANGEN_WORLDS_DIR "/models"}, {}});
}

TEST(EditsOfGravity, DevicesAndSensorsFeelANewOneAtOnce) {
  const std::unique_ptr<Simulation> world = world_of_weights();
  const auto run = [&](double seconds) {
    for (int i = 0; i < std::lround(1000 * seconds); ++i) world->tick();
    return world->snapshot();
  };
  const auto reading = [&](const std::string& name) {
    const auto snapshot = world->snapshot();
    const auto& sensors = snapshot->structure->sensors;
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      if (sensors[i].name == name) return *snapshot->reading(i);
    }
    throw Error("no sensor " + name);
  };
  run(3.0);  // the sensor has long been steady
  EXPECT_NEAR(reading("post").get<std::vector<double>>("acceleration")[2], 9.81, 1e-6);
  EXPECT_NEAR(reading("crate").get<double>("weight"), 5.0, 0.01);
  world->post(Edit(SetPhysics{world->snapshot()->structure->physics, {0.0, 0.0, -3.7}}));
  run(2.0);
  EXPECT_NEAR(reading("post").get<std::vector<double>>("acceleration")[2], 3.7, 1e-6);
  EXPECT_NEAR(reading("crate").get<double>("weight"), 5.0, 0.01) << "a mass remains";
  world->post(ToDevice{"elevator", "elevator", {"Floor1", {}, "", 0.0}});
  const auto structure = world->snapshot()->structure;
  const auto lift =
      std::find_if(structure->joints.begin(), structure->joints.end(),
                   [](const JointEntry& joint) { return joint.name == "elevator::lift"; });
  ASSERT_NE(lift, structure->joints.end());
  double highest = 0.0;
  for (int i = 0; i < 15000; ++i) {
    const auto snapshot = world->tick();
    highest = std::max(highest, snapshot->joint_positions[lift - structure->joints.begin()]);
  }
  EXPECT_NEAR(highest, 4.0, 0.002) << "carried by its new weight";
}

TEST_F(Edits, LightsComeChangeAndGo) {
  pause();
  const std::string sdf = "<light name='l' type='point'><pose>0 0 2 0 0 0</pose></light>";
  ASSERT_TRUE(edit(AddLight{load::light(sdf, "sun", {}), sdf}).ok);
  EXPECT_FALSE(edit(AddLight{load::light(sdf, "sun", {}), sdf}).ok);
  SetLight to{"sun", {0.5F, 0.25F, 0.0F}, false, Vec3::Zero(), {{1, 1, 1}, Quat::Identity()}};
  ASSERT_TRUE(edit(to).ok);
  ASSERT_TRUE(post(Reset{false}).ok);
  const auto structure = world_->snapshot()->structure;
  ASSERT_EQ(structure->lights.size(), 1U);
  EXPECT_EQ(structure->lights[0].light.diffuse[1], 0.25F);
  EXPECT_FALSE(structure->lights[0].light.cast_shadows);
  EXPECT_EQ(structure->lights[0].light.pose.position, Vec3(1, 1, 1));
  ASSERT_TRUE(edit(DeleteLight{"sun"}).ok);
  EXPECT_FALSE(edit(DeleteLight{"sun"}).ok);
  EXPECT_TRUE(world_->snapshot()->structure->lights.empty());
}

TEST_F(Edits, WhatCannotBeDoneSaysWhyAndChangesNothing) {
  pause();
  const Pose nan{{kNan, 0, 0}, Quat::Identity()};
  const Pose far{{1e9, 0, 0}, Quat::Identity()};
  const PushTime now{0, kSecond};
  const Vec3 up = Vec3::UnitZ();
  SetLinkProperties massless{"free::body", {}, true};
  massless.inertial.mass = 0.0;
  SetLinkProperties flat{"free::body", {}, true};
  flat.inertial.moment.setZero();
  SetLinkProperties impossible{"free::body", {}, true};
  impossible.inertial.moment.diagonal() << 100.0, 0.6, 0.6;
  const desc::Physics physics = world_->snapshot()->structure->physics;
  const std::vector<std::pair<Edit, std::string>> wrong = {
      {impossible, "no body has the principal moments"},
      {SetPhysics{physics, {0, 0, -1e6}}, "at least -10000 m/s^2"},
      {SetJointProperties{"slide::along", {}, {1e15}, {1e14}, {}, 0.0}, "no position within"},
      {SetModelState{"nobody", {}}, "no model named 'nobody'"},
      {SetModelState{"free::body", {}}, "not a model"},
      {SetModelState{"free", still({}, "nowhere")}, "nowhere"},
      {SetModelState{"free", still(nan)}, "finite"},
      {SetModelState{"free", still(far)}, "position"},
      {SetModelState{"free", {"", {}, {1e9, 0, 0}, Vec3::Zero()}}, "linear velocity"},
      {SetModelState{"free", {"", {}, Vec3::Zero(), {0, kNan, 0}}}, "angular velocity"},
      {SetLinkState{"free::nose", {}}, "nose"},
      {SetLinkState{"slide::car", {}}, "holds the link"},
      {SetJoints{"slide", {"along"}, {}}, "positions"},
      {SetJoints{"slide", {"across"}, {1}}, "across"},
      {SetJoints{"slide", {"along"}, {kNan}}, "position"},
      {SetJoints{"slide", {"fix"}, {1}}, "axis"},
      {PushLink{"floor::link", "", Vec3::Zero(), up, up, now}, "static"},
      {PushLink{"free::body", "", Vec3::Zero(), 1e30 * up, up, now}, "force"},
      {PushLink{"free::body", "", Vec3::Zero(), up, kNan * up, now}, "torque"},
      {PushJoint{"slide::fix", 1.0, now}, "axis"},
      {PushJoint{"slide::along", 1e300, now}, "effort"},
      {ClearPushes{"slide::nothing"}, "neither"},
      {massless, "mass"},
      {flat, "inertia"},
      {SetJointProperties{"slide::along", {-1.0}, {}, {}, {}, 0.0}, "negative"},
      {SetJointProperties{"slide::along", {1, 1}, {}, {}, {}, 0.0}, "axes"},
      {SetJointProperties{"slide::along", {}, {-5.0}, {}, {}, 0.0}, "limit"},
      {SetPhysics{physics, {0, 0, kNan}}, "gravity"},
      {SetLight{"nothing", {1, 1, 1}, true, up, {}}, "no light"},
      {DeleteLight{"nothing"}, "no light"},
  };
  const Motion before = see("free").entities[0];
  const auto structure = world_->snapshot()->structure;
  for (const auto& [edit_, part] : wrong) {
    const Outcome outcome = edit(edit_);
    EXPECT_FALSE(outcome.ok) << part;
    EXPECT_NE(outcome.message.find(part), std::string::npos) << part << ": " << outcome.message;
  }
  EXPECT_EQ(world_->snapshot()->structure, structure);
  EXPECT_EQ(see("free").entities[0].pose, before.pose);
  EXPECT_EQ(see("slide", "slide::along").joints[0].position, 0.0);
}

TEST(EditsAndLeaps, ALeapEndsWherePushesBeginAndGivesTheSameBits) {
  const auto run = [](bool leaps) {
    const auto world = world_of(kFree + kSlide);
    world->post(Edit(PushLink{"free::body",
                              "",
                              Vec3::Zero(),
                              {0.5, 0, 0},
                              {0, 0.2, 0},
                              {from_seconds(3.0004), from_seconds(0.7)}}));
    world->post(Edit(PushJoint{"slide::along", 0.5, {from_seconds(6), from_seconds(1)}}));
    const Nanoseconds end = 9 * kSecond;
    while (world->snapshot()->time < end) leaps ? world->leap(end) : world->tick();
    return world->snapshot();
  };
  const auto ticked = run(false);
  const auto leapt = run(true);
  ASSERT_EQ(ticked->time, leapt->time);
  for (std::size_t i = 0; i < ticked->link_poses.size(); ++i) {
    EXPECT_EQ(ticked->link_poses[i], leapt->link_poses[i]) << i;
  }
  EXPECT_GT(leapt->link_poses[0].position.x(), 0.5);
}

TEST(EditsAndSensors, AStaticModelThatIsMovedIsSeenWhereItIs) {
  const std::string eye =
      "<model name='eye'><static>true</static><pose>0 0 1 0 0 0</pose>"
      "<link name='link'>" +
      ray_sensor("gate", "liboptical_switch_controller.so", 10, 0.0) + "</link></model>";
  const std::string wall = body("wall", "<box><size>0.2 2 2</size></box>", "9 0 1 0 0 0", true);
  const auto world = world_of(eye + wall);
  for (int i = 0; i < 500; ++i) world->tick();
  const auto before = world->snapshot()->reading(0);
  world->post(Edit(SetModelState{"wall", still({{0.4, 0, 1}, Quat::Identity()})}));
  world->leap(world->snapshot()->time + kSecond);
  for (int i = 0; i < 200; ++i) world->tick();
  EXPECT_FALSE(before->same_values(*world->snapshot()->reading(0)));
}

}  // namespace
}  // namespace angen::sim

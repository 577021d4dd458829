#include <gtest/gtest.h>

#include <cmath>

#include "angen_sim/physics/models.h"
#include "core/limits.h"
#include "physics/ode.h"
#include "physics/solver.h"

namespace angen::physics {
namespace {

using namespace testing;

/// Gravity of that size along x.
World world_with(double gravity) { return {desc::Physics{}, Vec3(gravity, 0.0, 0.0), 1}; }

TEST(Stopped, AtTheGreatestSpeedWhileTheRestGoesOn) {
  World world = world_with(1e6);
  const ModelId fast = world.add(box_model("fast", 1.0, Vec3::Ones()));
  desc::Model other = box_model("other", 1.0, Vec3::Ones(), {0.0, 9.0, 0.0});
  other.links[0].gravity = false;
  const LinkId calm = world.links(world.add(other))[0];
  const LinkId link = world.links(fast)[0];
  world.push(calm, {1.0, 0.0, 0.0}, Vec3::Zero(), {0.0, 9.0, 0.0});
  int tick = 0;
  while (world.stopped().empty() && tick < 1000) {
    world.step(tick++);
    if (world.stopped().empty()) world.push(calm, {1.0, 0.0, 0.0}, Vec3::Zero(), {0.0, 9.0, 0.0});
  }
  EXPECT_NEAR(tick, 101, 2);  // 1e6 m/s^2 make 1e5 m/s in 0.1 s
  ASSERT_EQ(world.stopped().size(), 1U);
  EXPECT_EQ(world.stopped()[0].link, link);
  EXPECT_NE(world.stopped()[0].why.find("its speed would be"), std::string::npos);
  const Pose there = world.link(link).pose;
  EXPECT_FALSE(world.awake(link));
  EXPECT_TRUE(world.awake(calm));
  world.wake(link);
  world.push(link, {1e3, 0.0, 0.0}, Vec3::Zero(), Vec3::Zero());
  world.drive(link, {1.0, 0.0, 0.0}, 0.0, 10.0);
  world.step(tick++);
  EXPECT_EQ(world.link(link).pose, there) << "a stopped body does not move";
  EXPECT_TRUE(world.stopped().empty()) << "it is reported once";
  world.move(fast, Pose{});
  EXPECT_TRUE(world.awake(link));
  world.step(tick++);
  EXPECT_GT(world.link(link).linear_velocity.x(), 100.0);
}

TEST(Stopped, AtTheEndOfTheWorld) {
  World world = world_with(0.0);
  const LinkId link =
      world.links(world.add(box_model("far", 1.0, Vec3::Ones(), {999'999.0, 0.0, 0.0})))[0];
  int tick = 0;
  while (world.stopped().empty() && tick < 3000) {
    world.push(link, {1000.0, 0.0, 0.0}, Vec3::Zero(), world.link(link).pose.position);
    world.step(tick++);
  }
  ASSERT_EQ(world.stopped().size(), 1U);
  EXPECT_NE(world.stopped()[0].why.find("its position"), std::string::npos);
  EXPECT_LE(world.link(link).pose.position.x(), limits::kPosition.most);
}

TEST(Stopped, OneIsLikeAStaticBodyForOthers) {
  World world({}, kGravity, 1);
  const ModelId floor = world.add(static_box("floor", {10.0, 10.0, 1.0}, {0.0, 0.0, -0.5}));
  static_cast<void>(floor);
  const LinkId low = world.links(world.add(box_model("low", 1.0, Vec3::Ones(), {0, 0, 0.5})))[0];
  const LinkId top = world.links(world.add(box_model("top", 1.0, Vec3::Ones(), {0, 0, 3.0})))[0];
  int tick = 0;
  for (int i = 0; i < 20; ++i) {
    world.push(low, {0.0, 0.0, 0.0}, {0.0, 0.0, 1e9}, Vec3::Zero());
    world.step(tick++);
    if (!world.stopped().empty()) break;
  }
  ASSERT_FALSE(world.stopped().empty());
  for (int i = 0; i < 3000; ++i) world.step(tick++);
  EXPECT_FALSE(world.awake(top)) << "it is on it and sleeps";
  EXPECT_NEAR(world.link(top).pose.position.z(), 1.5, 0.3);
  bool touches = false;
  for (const ContactPair& pair : world.contacts()) {
    if (pair.first != "top::link::collision" && pair.second != "top::link::collision") continue;
    touches = true;
    double force = 0.0;
    for (const ContactPoint& point : pair.points) force += point.force.z();
    EXPECT_NEAR(std::abs(force), 9.81, 0.5);
  }
  EXPECT_TRUE(touches);
}

// ODE would abort: a torque that makes the spin infinite within the step.
TEST(Stopped, WhereOdeWouldAbort) {
  World world({}, Vec3::Zero(), 1);
  desc::Model light = box_model("light", 1e-9, Vec3::Ones());
  light.links[0].inertial.moment = 1e-300 * Eigen::Matrix3d::Identity();  // no file may say that
  const LinkId wild = world.links(world.add(light))[0];
  const LinkId calm =
      world.links(world.add(box_model("calm", 1.0, Vec3::Ones(), {5.0, 0.0, 0.0})))[0];
  for (int i = 0; i < 10; ++i) {
    world.push(calm, {1.0, 0.0, 0.0}, Vec3::Zero(), world.link(calm).pose.position);
    world.step(i);
  }
  const double speed = world.link(calm).linear_velocity.x();
  EXPECT_NEAR(speed, 0.01, 1e-9);
  world.push(wild, Vec3::Zero(), {1e9, 1e9, 0.0}, Vec3::Zero());
  world.step(10);
  ASSERT_EQ(world.stopped().size(), 1U);
  EXPECT_EQ(world.stopped()[0].link, wild);
  EXPECT_NEAR(world.link(calm).linear_velocity.x(), speed, 1e-9) << "it keeps its speed";
  for (int i = 11; i < 20; ++i) {
    world.push(calm, {1.0, 0.0, 0.0}, Vec3::Zero(), world.link(calm).pose.position);
    world.step(i);
  }
  EXPECT_NEAR(world.link(calm).linear_velocity.x(), 0.019, 1e-9);
  EXPECT_TRUE(world.stopped().empty());
}

TEST(OdeFailure, IsAnException) {
  ode::prepare_thread();
  EXPECT_THROW(dDebug(1, "assertion %d", 7), ode::Failure);
  EXPECT_THROW(dError(1, "error"), ode::Failure);
}

TEST(OdeFailure, OfAModelIsAnErrorAndAddsNothing) {
  World world({}, kGravity, 1);
  desc::Model model = box_model("m", 1.0, Vec3::Ones());
  model.links[0].pose.rotation.coeffs().setZero();  // no file gives that
  EXPECT_THROW(world.add(model), Error);
  world.step(0);
  EXPECT_EQ(world.awake_count(), 0U);
}

}  // namespace
}  // namespace angen::physics

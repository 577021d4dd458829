#include <gtest/gtest.h>

#include "core/diagnostics.h"
#include "models.h"

namespace angen::physics::testing {
namespace {

constexpr double kStep = 1e-3;

TEST(Bodies, FallAsTheSemiImplicitEulerSumSays) {
  TestWorld world;
  const LinkId link = world.only_link(world.add(box_model("box", 2.0, {0.1, 0.2, 0.3}, {0, 0, 9})));
  world.run(1.0);
  const int n = 1000;
  const double exact = 9.0 - 9.81 * kStep * kStep * n * (n + 1) / 2.0;
  EXPECT_NEAR(world.link(link).pose.position.z(), exact, 1e-9);
  EXPECT_NEAR(world.link(link).pose.position.z(), 9.0 - 0.5 * 9.81, 9.81 * kStep);
  EXPECT_NEAR(world.link(link).linear_velocity.z(), -9.81, 1e-9);
}

TEST(Bodies, TurnAboutTheirCentreOfMassNotTheirOrigin) {
  TestWorld world({}, Vec3::Zero());
  desc::Model model = box_model("box", 2.0, {0.1, 0.1, 0.1});
  model.links[0].inertial.pose.position = {0.5, 0.0, 0.0};
  model.links.push_back(
      ghost_link("hub", 1.0, {0.1, 0.1, 0.1}, {{0.5, 0.0, 0.0}, Quat::Identity()}));
  model.joints.push_back(
      joint_of(desc::Joint::Type::kRevolute, "hub", "link", Vec3::UnitZ(), {0.5, 0.0, 0.0}));
  const ModelId id = world.add(model);
  for (int i = 0; i < 500; ++i) {
    world.add_force(world.joints(id)[0], 0.01);
    world.step(i);
  }
  // The center stays, the origin goes round it.
  const LinkState state = world.link(world.links(id)[0]);
  EXPECT_NEAR((state.pose * Vec3(0.5, 0, 0) - Vec3(0.5, 0, 0)).norm(), 0.0, 1e-6);
  const double inertia = 2.0 / 12.0 * 0.02;
  EXPECT_NEAR(state.angular_velocity.z(), 0.01 * 0.5 / inertia, 1e-6);
  EXPECT_NEAR(state.linear_velocity.norm(), 0.5 * state.angular_velocity.z(), 1e-6);
}

TEST(Bodies, WithoutGravityStay) {
  TestWorld world;
  desc::Model model = box_model("box", 2.0, {0.1, 0.1, 0.1});
  model.links[0].gravity = false;
  const LinkId link = world.only_link(world.add(model));
  world.run(1.0);
  EXPECT_EQ(world.link(link).pose.position, Vec3::Zero());
}

TEST(Bodies, ThatAreHalfWeightlessFallWithHalfTheAcceleration) {
  TestWorld world;
  desc::Model model = model_of(
      "pair", {ghost_link("a", 1.0, {0.1, 0.1, 0.1}), ghost_link("b", 1.0, {0.1, 0.1, 0.1})});
  model.links[1].gravity = false;
  model.joints = {joint_of(desc::Joint::Type::kFixed, "a", "b")};
  const ModelId id = world.add(model);
  world.run(1.0);
  EXPECT_NEAR(world.link(world.links(id)[1]).linear_velocity.z(), -9.81 / 2, 1e-9);
}

TEST(Bodies, OnAPlaneSlideWithMuG) {
  TestWorld world;
  world.add(floor_model(0.3));
  desc::Model slider = box_model("box", 5.0, {0.4, 0.4, 0.1}, {0, 0, 0.05}, 0.3);
  slider.links.push_back(ghost_link("rod", 1e-3, {0.1, 0.1, 0.1}));
  const ModelId id = world.add(slider);
  const LinkId link = world.links(id)[0];
  world.drive(link, {2.0, 0.0, 0.0}, 0.0, 1e4);
  world.run(0.1);
  world.drive(link, Vec3::Zero(), 0.0, 0.0);
  const double before = world.link(link).linear_velocity.x();
  EXPECT_NEAR(before, 2.0, 1e-3);
  world.run(0.4);
  EXPECT_NEAR(before - world.link(link).linear_velocity.x(), 0.3 * 9.81 * 0.4, 0.01);
}

TEST(Bodies, AtRestSleepAndKeepTheirContactForces) {
  TestWorld world;
  world.add(floor_model());
  const LinkId link =
      world.only_link(world.add(box_model("box", 7.0, {0.4, 0.3, 0.2}, {0, 0, 0.12})));
  world.run(0.4);
  ASSERT_TRUE(world.awake(link));
  EXPECT_NEAR(force_on(world, "box::link::collision").z(), 7.0 * 9.81, 0.01 * 7.0 * 9.81);
  world.run(1.6);
  ASSERT_FALSE(world.awake(link));
  EXPECT_EQ(world.awake_count(), 0U);
  EXPECT_NEAR(force_on(world, "box::link::collision").z(), 7.0 * 9.81, 0.01 * 7.0 * 9.81);
  world.run(0.1);
  EXPECT_TRUE(world.moved().empty());
  ASSERT_EQ(world.contacts().size(), 1U);
  EXPECT_EQ(world.contacts()[0].first, "floor::link::collision");
  EXPECT_NEAR(world.contacts()[0].points.at(0).normal.z(), -1.0, 1e-9);
}

TEST(Bodies, TellWhatTouchesOneCollisionAwakeAndAsleep) {
  const std::string low = "low::link::collision";
  TestWorld world;
  world.add(floor_model());
  world.add(box_model("low", 7.0, {0.4, 0.3, 0.2}, {0, 0, 0.1}));
  const ModelId high = world.add(box_model("high", 1.0, {0.2, 0.2, 0.2}, {0, 0, 0.3}));
  for (const std::size_t awake : {2U, 0U}) {
    world.run(awake > 0 ? 0.3 : 2.0);
    ASSERT_EQ(world.awake_count(), awake);
    const std::vector<ContactPair> pairs = world.contacts(world.collision(low));
    ASSERT_EQ(pairs.size(), 2U);
    EXPECT_EQ(pairs[0].second, "floor::link::collision");
    EXPECT_EQ(pairs[1].second, "high::link::collision");
    Vec3 sum = Vec3::Zero();
    for (const ContactPair& pair : pairs) {
      EXPECT_EQ(pair.first, low);
      for (const ContactPoint& point : pair.points) {
        EXPECT_GT(point.force.dot(point.normal), 0.0);
        sum += point.force;
      }
    }
    EXPECT_LT((sum - force_on(world, low)).norm(), 1e-9);
  }
  world.remove(high);
  world.run(2.0);
  ASSERT_EQ(world.awake_count(), 0U);
  EXPECT_EQ(world.contacts(world.collision(low)).size(), 1U);
  EXPECT_EQ(world.contacts(world.collision("floor::link::collision")).size(), 1U);
  EXPECT_FALSE(world.collision("high::link::collision").valid());
  EXPECT_TRUE(world.contacts({}).empty());
}

TEST(Bodies, TellWhenWhatTouchesOneCollisionHasChanged) {
  TestWorld world;
  world.add(floor_model());
  world.add(box_model("low", 7.0, {0.4, 0.3, 0.2}, {0, 0, 0.1}));
  world.add(box_model("aside", 7.0, {0.4, 0.3, 0.2}, {3, 0, 0.1}));
  const CollisionId low = world.collision("low::link::collision");
  const CollisionId aside = world.collision("aside::link::collision");
  std::uint64_t known[2] = {};
  const auto changes = [&] {
    const std::uint64_t now[2] = {world.contacts_revision(low), world.contacts_revision(aside)};
    const std::pair<bool, bool> changed(now[0] != known[0], now[1] != known[1]);
    std::copy(now, now + 2, known);
    return changed;
  };
  using Changes = std::pair<bool, bool>;
  world.run(0.1);
  EXPECT_EQ(changes(), Changes(true, true));
  world.run(0.1);
  EXPECT_EQ(changes(), Changes(true, true));  // awake: forces may differ
  world.run(2.0);
  changes();
  world.run(1.0);
  EXPECT_EQ(changes(), Changes(false, false));
  const ModelId falling = world.add(box_model("falling", 1.0, {0.2, 0.2, 0.2}, {0, 0, 0.5}));
  world.run(0.1);
  EXPECT_EQ(changes(), Changes(false, false));  // in the air
  world.run(0.3);
  EXPECT_EQ(changes(), Changes(true, false));
  world.run(2.0);
  changes();
  world.run(1.0);
  ASSERT_EQ(world.awake_count(), 0U);
  EXPECT_EQ(changes(), Changes(false, false));
  world.remove(falling);
  EXPECT_EQ(changes(), Changes(true, false));
}

TEST(Bodies, FallWhenWhatTheyRestOnIsRemoved) {
  TestWorld world;
  const ModelId floor = world.add(floor_model());
  const LinkId link =
      world.only_link(world.add(box_model("box", 7.0, {0.4, 0.3, 0.2}, {0, 0, 0.1})));
  world.run(2.0);
  ASSERT_FALSE(world.awake(link));
  world.remove(floor);
  EXPECT_TRUE(world.awake(link));
  world.run(0.5);
  EXPECT_LT(world.link(link).pose.position.z(), -1.0);
  EXPECT_TRUE(world.contacts().empty());
}

TEST(Bodies, WakeWhenWhatTheyRestOnIsMoved) {
  TestWorld world;
  const ModelId floor = world.add(floor_model());
  const LinkId link =
      world.only_link(world.add(box_model("box", 7.0, {0.4, 0.3, 0.2}, {0, 0, 0.1})));
  world.run(2.0);
  world.place(floor, {{0, 0, -1.1}, Quat::Identity()});
  world.run(2.0);
  EXPECT_NEAR(world.link(link).pose.position.z(), -0.9, 1e-3);
  EXPECT_FALSE(world.awake(link));
}

TEST(Bodies, WakeWhenSomethingFallsOnThem) {
  TestWorld world;
  world.add(floor_model());
  const LinkId low =
      world.only_link(world.add(box_model("low", 7.0, {0.4, 0.3, 0.2}, {0, 0, 0.1})));
  world.run(2.0);
  ASSERT_FALSE(world.awake(low));
  world.add(box_model("high", 1.0, {0.2, 0.2, 0.2}, {0, 0, 0.5}));
  world.run(0.1);
  EXPECT_FALSE(world.awake(low));
  world.run(0.3);
  EXPECT_TRUE(world.awake(low));
  world.run(2.0);
  EXPECT_EQ(world.awake_count(), 0U);
  EXPECT_NEAR(force_on(world, "low::link::collision").z(), 7.0 * 9.81, 0.7);
  EXPECT_NEAR(force_on(world, "high::link::collision").z(), 1.0 * 9.81, 0.1);
}

TEST(Bodies, WithABadMassAreRefusedAndNothingIsAdded) {
  TestWorld world;
  desc::Model model = model_of("m", {box_link("a", 1.0, {1, 1, 1}), box_link("b", 0.0, {1, 1, 1})});
  model.links[1].source = {"m.sdf", 7};
  try {
    world.add(model);
    FAIL() << "a mass of 0 was taken";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find("m.sdf:7: "), 0U) << error.what();
  }
  EXPECT_EQ(world.awake_count(), 0U);
  world.run(0.01);
}

TEST(Bodies, ThatAreKinematicStayWhereTheyArePlaced) {
  TestWorld world;
  desc::Model model = box_model("box", 1.0, {1, 1, 1}, {0, 0, 3});
  model.links[0].kinematic = true;
  const ModelId id = world.add(model);
  world.run(0.5);
  EXPECT_EQ(world.link(world.only_link(id)).pose.position.z(), 3.0);
  EXPECT_EQ(world.mass(world.only_link(id)), 0.0);
}

}  // namespace
}  // namespace angen::physics::testing

// Touching shapes are found, and overlapping ones are parted gently.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "angen_sim/physics/models.h"

namespace angen::physics::testing {
namespace {

const std::vector<std::pair<const char*, Shape>>& shapes() {
  using Type = Shape::Type;
  static const std::vector<std::pair<const char*, Shape>> all = {
      {"box", box_shape({0.2, 0.2, 0.2})},
      {"sphere", round_shape(Type::kSphere, 0.1)},
      {"cylinder", round_shape(Type::kCylinder, 0.1, 0.2)},
      {"capsule", round_shape(Type::kCapsule, 0.1, 0.2)}};
  return all;
}

desc::Model body(const std::string& name, const Shape& shape, const Pose& pose, bool is_static) {
  desc::Link link = box_link("link", 1.0, {0.2, 0.2, 0.2});
  link.collisions = {collision(shape)};
  desc::Model model = model_of(name, {link}, pose);
  model.is_static = is_static;
  return model;
}

// Also where ODE has no normal for them: concentric, or exactly side by side.
TEST(Contacts, WhatIsPutIntoAnotherIsPartedSlowly) {
  for (const auto& [first_name, first] : shapes()) {
    for (const auto& [second_name, second] : shapes()) {
      for (const Vec3& offset :
           {Vec3(0, 0, 0), Vec3(0.1, 0, 0), Vec3(0.2, 0, 0), Vec3(0, 0, 0.1), Vec3(0.1, 0.1, 0)}) {
        TestWorld world({}, Vec3::Zero());
        world.add(body("first", first, {}, true));
        const LinkId link =
            world.only_link(world.add(body("second", second, {offset, Quat::Identity()}, false)));
        for (int i = 0; i < 300; ++i) {
          world.run(0.001);
          const double speed = world.link(link).linear_velocity.norm();
          ASSERT_LT(speed, 2.0) << second_name << " in " << first_name << " at " << offset;
        }
        EXPECT_EQ(world.failed_steps(), 0U) << second_name << " in " << first_name << offset;
      }
    }
  }
}

// A collision's own minimum depth replaces the layer of the world.
TEST(Contacts, MinDepthTakesThePlaceOfTheSurfaceLayer) {
  desc::Physics settings;
  settings.contact_surface_layer = 0.01;
  settings.contact_max_correcting_vel = 0.05;  // m/s, so that it does not fly out
  for (const auto& [min_depth, sunk] : {std::pair<double, double>{-1.0, 0.01}, {0.001, 0.001}}) {
    TestWorld world(settings);
    world.add(floor_model());
    desc::Model box = box_model("box", 2.0, {0.2, 0.2, 0.2}, {0, 0, 0.08});
    if (min_depth >= 0.0) box.links[0].collisions[0].min_depth = min_depth;
    const LinkId link = world.only_link(world.add(box));
    world.run(1.5);
    EXPECT_NEAR(0.1 - world.link(link).pose.position.z(), sunk, 5e-4);
  }
}

// Past its middle it would be pushed out below.
TEST(Contacts, AMinDepthLetsNothingSinkThroughAThinBox) {
  TestWorld world;
  world.add(body("sheet", box_shape({4.0, 4.0, 0.001}), {{0, 0, 0.0225}, Quat::Identity()}, true));
  desc::Model ball = body("ball", round_shape(Shape::Type::kSphere, 0.033),
                          {{0, 0, 0.06}, Quat::Identity()}, false);
  ball.links[0].collisions[0].min_depth = 0.001;
  const LinkId link = world.only_link(world.add(ball));
  world.run(1.0);
  EXPECT_NEAR(world.link(link).pose.position.z(), 0.056, 5e-4);
}

TEST(Contacts, AreListedByCollisionAwakeAndAsleep) {
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

TEST(Contacts, RevisionOfACollisionGrowsWithItsContacts) {
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

TEST(Contacts, WhatTouchedLatelyIsRememberedForAWhile) {
  TestWorld world;
  world.add(floor_model());
  desc::Model ball = box_model("ball", 1.0, {0.1, 0.1, 0.1}, {0, 0, 0.05});
  const LinkId link = world.only_link(world.add(ball));
  const CollisionId collision = world.collision("ball::link::collision");
  EXPECT_TRUE(world.contacts_since(collision, 0).empty());
  world.run(0.1);
  world.set_velocity(link, {0.0, 0.0, 3.0}, Vec3::Zero());
  world.run(0.1);  // ticks 100 to 199; it is in the air
  EXPECT_TRUE(world.contacts(collision).empty());
  const std::vector<ContactPair> lately = world.contacts_since(collision, 50);
  ASSERT_EQ(lately.size(), 1U);
  EXPECT_EQ(lately[0].first, "ball::link::collision");
  EXPECT_EQ(lately[0].second, "floor::link::collision");
  EXPECT_TRUE(world.contacts_since(collision, 150).empty());
}

TEST(Contacts, LinksOfAModelTouchWhereBothCollideWithTheirOwn) {
  for (const auto& [lower, upper] : {std::pair(true, true), {true, false}, {false, false}}) {
    TestWorld world;
    desc::Model pair = model_of(
        "pair", {box_link("lower", 1.0, {0.2, 0.2, 0.2}),
                 box_link("upper", 1.0, {0.2, 0.2, 0.2}, {{0, 0, 0.3}, Quat::Identity()})});
    pair.links[0].self_collide = lower;
    pair.links[1].self_collide = upper;
    pair.joints = {joint_of(desc::Joint::Type::kFixed, "world", "lower")};
    const ModelId id = world.add(pair);
    world.run(0.5);
    const double height = world.link(world.links(id)[1]).pose.position.z();
    if (lower && upper) {
      EXPECT_NEAR(height, 0.2, 0.002);
    } else {
      EXPECT_LT(height, 0.0);
    }
  }
}

// 300 in one place would have 180,000 points.
TEST(Contacts, OfACrowdAreLeftOutButNotTheFloor) {
  TestWorld world;
  world.add(floor_model());
  for (int i = 0; i < 300; ++i) {
    world.add(box_model("box" + std::to_string(i), 1.0, {0.2, 0.2, 0.2}, {0, 0, 0.0999}));
  }
  world.run(1e-3);
  EXPECT_TRUE(world.crowded());
  const std::vector<ContactPair> pairs = world.contacts();
  const auto on_floor = [](const ContactPair& pair) {
    return pair.first == "floor::link::collision";
  };
  EXPECT_EQ(std::count_if(pairs.begin(), pairs.end(), on_floor), 300);
  EXPECT_LT(pairs.size(), 6000U);
}

}  // namespace
}  // namespace angen::physics::testing

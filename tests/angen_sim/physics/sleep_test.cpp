#include "physics/sleep.h"

#include <gtest/gtest.h>

#include "models.h"

namespace angen::physics::testing {
namespace {

TEST(Sleep, AtRestSleepAndKeepTheirContactForces) {
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

TEST(Sleep, FallWhenWhatTheyRestOnIsRemoved) {
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

TEST(Sleep, WakeWhenSomethingFallsOnThem) {
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

}  // namespace
}  // namespace angen::physics::testing

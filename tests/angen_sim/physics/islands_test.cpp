#include "physics/islands.h"

#include <gtest/gtest.h>

#include "models.h"

namespace angen::physics::testing {
namespace {

const Vec3 kBrick(0.24, 0.12, 0.06);

/// Bricks of 2 kg in courses of 10, 9, 8, 7 and 6, each on two of the course below: 280 contact
/// points.
template <class Add>
void build_wall(const Add& add) {
  for (int course = 0; course < 5; ++course) {
    for (int i = 0; i < 10 - course; ++i) {
      const std::string name = "brick" + std::to_string(course) + std::to_string(i);
      add(box_model(name, 2.0, kBrick, {0.25 * i + 0.125 * course, 0.0, 0.06 * course + 0.03}));
    }
  }
}

TEST(Islands, AreLargeByTheirOwnContacts) {
  const auto marked = [](std::size_t points) {
    Body bodies[4], ground;
    Geom geoms[4], floor;
    floor.body = &ground;
    std::vector<Body*> awake;
    for (int i = 0; i < 4; ++i) {
      bodies[i].mass = 1.0;
      bodies[i].awake = true;
      geoms[i].body = &bodies[i];
      awake.push_back(&bodies[i]);
    }
    // Two touch each other, all are on the floor, which connects nothing.
    const bool any = mark_large_islands(awake, {{&geoms[0], &geoms[2], 0, points - 40},
                                                {&floor, &geoms[0], 0, 40},
                                                {&floor, &geoms[1], 0, 90},
                                                {&geoms[3], &floor, 0, 90}});
    std::vector<bool> out{any};
    for (const Body& body : bodies) out.push_back(body.iterated);
    return out;
  };
  EXPECT_EQ(marked(100), (std::vector<bool>{false, false, false, false, false}));
  EXPECT_EQ(marked(101), (std::vector<bool>{true, true, false, true, false}));
}

TEST(Islands, ALargeOneStandsAndFallsAsleep) {
  TestWorld world;
  world.add(floor_model());
  std::vector<std::pair<LinkId, Vec3>> bricks;
  build_wall([&](const desc::Model& brick) {
    bricks.emplace_back(world.only_link(world.add(brick)), brick.pose.position);
  });
  world.run(0.3);
  EXPECT_EQ(world.awake_count(), bricks.size());
  const double weight = 2.0 * 9.81 * static_cast<double>(bricks.size());
  EXPECT_NEAR(force_on(world, "floor::link::collision").z(), -weight, 0.02 * weight);
  world.run(3.0);
  EXPECT_EQ(world.awake_count(), 0U);
  for (const auto& [link, start] : bricks) {
    EXPECT_NEAR((world.link(link).pose.position - start).norm(), 0.0, 2e-3);
  }
}

TEST(Islands, WhatStandsApartGoesOnAsWithoutALargeOne) {
  const auto slide = [](bool wall) {
    TestWorld world;
    world.add(floor_model());
    const LinkId box = world.only_link(world.add(box_model("box", 2.0, kBrick, {0, 3, 0.03}, 0.3)));
    if (wall) build_wall([&](const desc::Model& brick) { world.add(brick); });
    world.push(box, {300.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0, 3, 0.03});
    world.run(0.2);
    return world.link(box);
  };
  const LinkState with = slide(true);
  const LinkState without = slide(false);
  EXPECT_GT(without.pose.position.x(), 1e-6);
  EXPECT_EQ(with.pose, without.pose);
  EXPECT_EQ(with.linear_velocity, without.linear_velocity);
}

}  // namespace
}  // namespace angen::physics::testing

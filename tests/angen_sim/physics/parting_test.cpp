// Bodies that were put into others come out of them without being thrown.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "angen_sim/physics/models.h"
#include "core/random.h"

namespace angen::physics::testing {
namespace {

desc::Collision part(const std::string& name, const Vec3& size, const Vec3& at) {
  desc::Collision c = collision(box_shape(size), 0.6, {at, Quat::Identity()});
  c.name = name;
  return c;
}

/// A table of a top and four legs.
desc::Model table(const std::string& name, const Pose& pose, bool is_static) {
  desc::Link link = box_link("link", 20.0, {1.2, 0.8, 0.7});
  link.collisions = {part("top", {1.2, 0.8, 0.04}, {0, 0, 0.35})};
  int leg = 0;
  for (const double x : {-0.55, 0.55}) {
    for (const double y : {-0.35, 0.35}) {
      link.collisions.push_back(part("leg" + std::to_string(leg++), {0.06, 0.06, 0.7}, {x, y, 0}));
    }
  }
  desc::Model model = model_of(name, {link}, pose);
  model.is_static = is_static;
  return model;
}

Pose random_pose(Rng& rng, double reach, double height) {
  const Vec3 at((2.0 * rng.uniform() - 1.0) * reach, (2.0 * rng.uniform() - 1.0) * reach,
                height * rng.uniform());
  return {at, from_rpy(6.28 * rng.uniform(), 6.28 * rng.uniform(), 6.28 * rng.uniform())};
}

/// The largest excess over the speed of a free fall, by a body's speed and by its way.
struct Watch {
  World& world;
  LinkId link;
  Vec3 last;
  double top;
  double excess = 0.0;  // m/s

  Watch(World& of, LinkId id)
      : world(of), link(id), last(of.link(id).pose.position), top(last.z()) {}
  void see(double g) {
    const LinkState now = world.link(link);
    top = std::max(top, now.pose.position.z());
    const double fall = std::sqrt(2.0 * g * (top - now.pose.position.z()));
    const double way = (now.pose.position - last).norm() / kStep;
    excess = std::max({excess, now.linear_velocity.norm() - fall, way - fall});
    last = now.pose.position;
  }
};

TEST(Parting, APanelAcrossTheCornerOfATableIsNotThrown) {
  TestWorld world;
  world.add(floor_model());
  desc::Model corner = table("table", {{0, 0, 0.35}, Quat::Identity()}, true);
  world.add(corner);
  const LinkId panel =
      world.only_link(world.add(model_of("panel", {box_link("link", 50.0, {0.9, 0.5, 0.03})},
                                         {{0.55, 0.35, 0.6}, from_rpy(0.4, 0.5, 0.8)})));
  Watch watch(world, panel);
  for (int i = 0; i < 1500; ++i) {
    world.run(kStep);
    watch.see(9.81);
  }
  printf("panel across the corner of a table: %.2f m/s beyond its fall\n", watch.excess);
  EXPECT_LT(watch.excess, 2.0);
}

/// A panel of 50 kg, tilted by `tilt` (rad), between a static box below its lower edge and one
/// whose edge is `inward` (m) from there above it; both overlap it by `deep` (m). Its largest
/// speed.
double fastest_wedged(double tilt, double inward, double deep) {
  TestWorld world({}, Vec3::Zero());
  const Quat turned = from_rpy(0.0, -tilt, 0.0);
  const Vec3 edge = turned * Vec3(-0.45, 0.0, -0.015);
  const Vec3 at(0.0, 0.0, -edge.z() - deep);
  const Vec3 pinched = at + turned * Vec3(-0.45 + inward, 0.0, 0.015);
  world.add(static_box("below", {3.0, 3.0, 0.4}, {0.0, 0.0, -0.2}));
  world.add(static_box("above", {0.4, 3.0, 0.4}, pinched + Vec3(-0.2, 0.0, 0.2 - deep)));
  const LinkId panel = world.only_link(world.add(
      model_of("panel", {box_link("link", 50.0, {0.9, 0.5, 0.03}, {}, 0.1)}, {at, turned})));
  double fastest = 0.0;
  for (int tick = 0; tick < 200; ++tick) {
    world.run(kStep);
    fastest = std::max(fastest, world.link(panel).linear_velocity.norm());
  }
  return fastest;
}

// Contacts that almost face each other drive a wedge out as much faster as its angle is small.
TEST(Parting, AWedgedPanelIsNotThrownByShallowOverlaps) {
  for (const double deep : {0.0011, 0.002, 0.003, 0.004, 0.005, 0.01}) {
    double fastest = 0.0;
    for (int i = 0; i < 60; ++i) {
      fastest =
          std::max(fastest, fastest_wedged(0.01 + 0.005 * (i % 20), 0.02 * (1 + i / 20), deep));
    }
    printf("panel wedged between two boxes, %.1f mm deep: %.2f m/s\n", 1000.0 * deep, fastest);
    EXPECT_LT(fastest, 0.2);
  }
}

// The hinge and its stop, too, give back without a throw what a box between leaf and wall bends.
TEST(Parting, ABoxJammedAtALeafStays) {
  Rng rng(10, 11, 12);
  double fastest = 0.0;
  for (int i = 0; i < 100; ++i) {
    TestWorld world({}, Vec3::Zero());
    const ModelId door = world.add(door_model("door"));  // its stop holds it from +y
    world.add(static_box("wall", {2.0, 0.1, 2.2}, {0.4, -0.17, 1.0}));
    const Vec3 at(0.1 + 0.65 * rng.uniform(), -0.07, 0.3 + 1.4 * rng.uniform());
    const Quat turned = from_rpy(0.3 * rng.uniform(), 0.3 * rng.uniform(), 0.6 * rng.uniform());
    const desc::Link box = box_link("link", 2.0, {0.11, 0.11, 0.11});
    const LinkId link = world.only_link(world.add(model_of("box", {box}, {at, turned})));
    const LinkId leaf = world.links(door)[1];
    for (int tick = 0; tick < 500; ++tick) {
      world.run(kStep);
      for (const LinkId each : {link, leaf}) {
        const LinkState state = world.link(each);
        const double speed = state.linear_velocity.norm();
        fastest = std::max(fastest, speed);
      }
    }
    EXPECT_LT(std::abs(world.joint(world.joints(door)[1]).position), 0.3);
  }
  printf("box jammed between a leaf and a wall: %.3f m/s\n", fastest);
  EXPECT_LT(fastest, 0.05);
}

// A block below its corner bends a leaf's hinge. Once the block is gone the hinge takes the leaf
// back in a step, which is no speed either.
TEST(Parting, ABentHingeComesBackWithoutSpeed) {
  for (const double deep : {0.003, 0.01, 0.05}) {
    TestWorld world;
    const ModelId door = world.add(door_model("door"));
    const LinkId leaf = world.links(door)[1];
    const ModelId block =
        world.add(static_box("block", {0.1, 0.1, 0.1}, {0.75, 0.0, 0.01 - 0.05 + deep}));
    world.push(leaf, Vec3::UnitY(), Vec3::Zero(), world.link(leaf).pose.position);  // wakes it
    world.run(0.1);
    const double bent = world.link(leaf).pose.position.z() - 1.01;
    world.remove(block);
    double fastest = 0.0;
    for (int tick = 0; tick < 100; ++tick) {
      world.run(kStep);
      fastest = std::max(fastest, world.link(leaf).linear_velocity.norm());
    }
    printf("a leaf bent by %.3f mm: %.5f m/s\n", 1000.0 * bent, fastest);
    EXPECT_GT(bent, 2e-5);
    EXPECT_LT(fastest, 0.005);
  }
}

// The push out of an overlap is no force: without gravity nothing gets energy.
TEST(Parting, WithoutGravityOverlappingBodiesGetNoSpeed) {
  Rng rng(1, 2, 3);
  double most = 0.0;
  double fastest = 0.0;
  for (int i = 0; i < 15; ++i) {
    TestWorld world({}, Vec3::Zero());
    world.add(table("fixed", {{0, 0, 0.35}, Quat::Identity()}, true));
    std::vector<LinkId> loose;
    for (int k = 0; k < 3; ++k) {
      loose.push_back(world.only_link(
          world.add(table("loose" + std::to_string(k), random_pose(rng, 0.4, 0.7), false))));
    }
    std::vector<Watch> watches;
    for (const LinkId link : loose) watches.emplace_back(world, link);
    for (int tick = 0; tick < 500; ++tick) {
      world.run(kStep);
      double energy = 0.0;  // J, without turning
      for (Watch& watch : watches) {
        watch.see(0.0);
        energy += 10.0 * world.link(watch.link).linear_velocity.squaredNorm();
        fastest = std::max(fastest, watch.excess);
      }
      most = std::max(most, energy);
    }
  }
  printf("four tables in each other, 15 times: at most %.3f J, %.2f m/s\n", most, fastest);
  EXPECT_LT(most, 0.5 * 60.0 * 0.1 * 0.1);
  EXPECT_LT(fastest, 1.1);
}

// Nor does a joint of any type that the push bends.
TEST(Parting, WithoutGravityJointedBodiesGetNoSpeed) {
  using Type = desc::Joint::Type;
  for (const Type type : {Type::kBall, Type::kUniversal, Type::kRevolute, Type::kPrismatic}) {
    Rng rng(4, 5, 6);
    double fastest = 0.0;
    for (int i = 0; i < 10; ++i) {
      TestWorld world({}, Vec3::Zero());
      world.add(static_box("floor", {4.0, 4.0, 0.4}, {0.0, 0.0, -0.2}));
      world.add(static_box("wall", {0.4, 4.0, 2.0}, {0.4, 0.0, 1.0}));
      world.add(static_box("other", {4.0, 0.4, 2.0}, {0.0, 0.4, 1.0}));
      std::vector<LinkId> loose;
      for (const double mass : {100.0, 5.0, 0.3}) {
        desc::Model pair =
            model_of("pair" + std::to_string(loose.size()),
                     {box_link("a", mass, {0.4, 0.3, 0.2}),
                      box_link("b", 0.3 * mass, {0.3, 0.2, 0.1}, {{0.35, 0, 0}, Quat::Identity()})},
                     random_pose(rng, 0.3, 0.4));
        pair.joints = {joint_of(type, "a", "b", Vec3::UnitZ(), {0.2, 0.0, 0.0})};
        if (type == Type::kUniversal) {
          pair.joints[0].axes.resize(2);
          pair.joints[0].axes[0].xyz = Vec3::UnitZ();
          pair.joints[0].axes[1].xyz = Vec3::UnitY();
        }
        const ModelId id = world.add(pair);
        for (const LinkId link : world.links(id)) loose.push_back(link);
      }
      for (int tick = 0; tick < 500; ++tick) {
        world.run(kStep);
        for (const LinkId link : loose) {
          fastest = std::max(fastest, world.link(link).linear_velocity.norm());
        }
      }
    }
    printf("three pairs in a corner, joint type %d, 10 times: at most %.3f m/s\n",
           static_cast<int>(type), fastest);
    EXPECT_LT(fastest, 0.1) << static_cast<int>(type);
  }
}

// A push that turns a body keeps its spin about the axes of the body. A rod has little inertia
// about one of them: turned under a spin that stays as it is in the world, it would get energy.
TEST(Parting, APushThatTurnsASpinningRodGivesItNoEnergy) {
  Rng rng(13, 14, 15);
  const auto between = [&](double low, double high) { return low + (high - low) * rng.uniform(); };
  double most = 0.0;  // J
  for (int i = 0; i < 60; ++i) {
    TestWorld world({}, Vec3::Zero());
    world.add(static_box("block", {0.4, 0.4, 0.4}, {0.0, 0.0, 0.0}));
    const desc::Link link = box_link("link", 10.0, {1.2, 0.1, 0.1}, {}, 0.0);
    const Pose at{{between(-0.3, 0.3), between(-0.3, 0.3), between(-0.3, 0.3)},
                  from_rpy(between(-3, 3), between(-1, 1), between(-3, 3))};
    const LinkId id = world.only_link(world.add(model_of("rod", {link}, at)));
    world.set_velocity(id, Vec3::Zero(), {between(-2, 2), between(-2, 2), between(-2, 2)});
    const auto energy = [&] {
      const LinkState now = world.link(id);
      const Vec3 spin = now.pose.rotation.conjugate() * now.angular_velocity;
      return 0.5 * link.inertial.mass * now.linear_velocity.squaredNorm() +
             0.5 * spin.dot(link.inertial.moment * spin);
    };
    double least = energy();
    for (int tick = 0; tick < 300; ++tick) {
      world.run(kStep);
      most = std::max(most, energy() - least);
      least = std::min(least, energy());
    }
  }
  printf("a spinning rod in a block, 60 times: at most %.5f J gained\n", most);
  EXPECT_LT(most, 0.003);
}

TEST(Parting, OnAFloorTheyAreNoFasterThanTheirFall) {
  Rng rng(4, 5, 6);
  double most = 0.0;
  for (int i = 0; i < 8; ++i) {
    TestWorld world;
    world.add(floor_model());
    world.add(table("fixed", {{0, 0, 0.35}, Quat::Identity()}, true));
    std::vector<Watch> watches;
    for (int k = 0; k < 2; ++k) {
      watches.emplace_back(
          world, world.only_link(world.add(
                     table("loose" + std::to_string(k), random_pose(rng, 0.6, 0.7), false))));
    }
    for (int tick = 0; tick < 500; ++tick) {
      world.run(kStep);
      for (Watch& watch : watches) watch.see(9.81);
    }
    for (const Watch& watch : watches) most = std::max(most, watch.excess);
    EXPECT_EQ(world.stopped().size(), 0U);
  }
  printf("three tables in each other on a floor, 8 times: %.2f m/s beyond their fall\n", most);
  EXPECT_LT(most, 2.0);
}

}  // namespace
}  // namespace angen::physics::testing

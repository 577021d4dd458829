#include <gtest/gtest.h>

#include "core/diagnostics.h"
#include "core/random.h"
#include "robot.h"

namespace angen::physics::testing {
namespace {

template <class T>
void hash_value(std::uint64_t& hash, const T& value) {
  hash = hash_bytes({reinterpret_cast<const char*>(&value), sizeof value}, hash);
}

/// A house in small: doors, falling boxes, a lift and a robot that drives about.
class Scene {
 public:
  Scene() {
    world_.add(floor_model());
    for (int i = 0; i < 3; ++i)
      doors_.push_back(add(door_model("door" + std::to_string(i), {3.0 * i, 4, 0})));
    for (int i = 0; i < 12; ++i) {
      desc::Model box = box_model("box" + std::to_string(i), 1.0 + i, {0.2, 0.25, 0.3});
      box.pose = {{0.3 * (i % 3), 0.25 * (i % 2) - 2.0, 0.4 + 0.33 * i}, from_rpy(0.1 * i, 0.2, i)};
      add(box);
    }
    robot_ = add(robot_model("robot", {0, -1, 0}));
    add(person_model("person", {-3, 0, 0.001}));
  }

  void step(int i) {
    for (const ModelId door : doors_) {
      const JointState hinge = world_.joint(world_.joints(door)[1]);
      const double target = (i / 4000) % 2 == 0 ? -1.0 : -0.2;
      if (std::abs(target - hinge.position) > 0.01) {
        world_.add_force(world_.joints(door)[1],
                         70.0 * (target - hinge.position) - 25.0 * hinge.velocity);
      }
    }
    world_.set_motor(world_.joints(robot_)[0], i % 2000 < 1000 ? 4.0 : -2.0, 1.0);
    world_.set_motor(world_.joints(robot_)[1], i % 3000 < 1500 ? 5.0 : -3.0, 1.0);
    world_.drive(world_.links(models_.back())[0], {i % 4000 < 2000 ? 1.0 : -1.0, 0.2, 0}, 0.3,
                 150.0);
    world_.step(i);
  }

  std::uint64_t hash() const {
    std::uint64_t hash = hash_bytes("");
    for (const ModelId model : models_) {
      for (const LinkId link : world_.links(model)) {
        const LinkState s = world_.link(link);
        for (int k = 0; k < 3; ++k) {
          hash_value(hash, s.pose.position[k]);
          hash_value(hash, s.linear_velocity[k]);
          hash_value(hash, s.angular_velocity[k]);
        }
        for (int k = 0; k < 4; ++k) hash_value(hash, s.pose.rotation.coeffs()[k]);
      }
      for (const JointId joint : world_.joints(model)) {
        hash_value(hash, world_.joint(joint).position);
        hash_value(hash, world_.joint(joint).effort);
      }
    }
    for (const ContactPair& pair : world_.contacts()) {
      hash = hash_bytes(pair.first + pair.second, hash);
      for (const ContactPoint& p : pair.points) {
        for (int k = 0; k < 3; ++k) hash_value(hash, p.force[k]);
      }
    }
    return hash;
  }

  const World& world() const { return world_; }

 private:
  ModelId add(const desc::Model& model) {
    models_.push_back(world_.add(model));
    return models_.back();
  }

  TestWorld world_;
  std::vector<ModelId> models_;
  std::vector<ModelId> doors_;
  ModelId robot_;
};

constexpr int kTenSeconds = 10000;

std::uint64_t run_scene() {
  Scene scene;
  for (int i = 0; i < kTenSeconds; ++i) scene.step(i);
  return scene.hash();
}

TEST(Determinism, TwoWorldsInTurnOnOneThreadAreBitIdentical) {
  Scene one;
  Scene two;
  for (int i = 0; i < kTenSeconds; ++i) {
    one.step(i);
    if (i % 3 == 2) {
      for (int k = i - 2; k <= i; ++k) two.step(k);
    }
  }
  two.step(kTenSeconds - 1);
  EXPECT_EQ(one.hash(), two.hash());
  EXPECT_EQ(one.hash(), run_scene());
}

TEST(World, ThirtyBoxesAtRestDriftLessThanATenthOfAMillimetre) {
  TestWorld world;
  world.add(floor_model());
  std::vector<LinkId> boxes;
  for (int i = 0; i < 30; ++i) {
    const Vec3 at(0.6 * (i / 3 % 5), 0.6 * (i / 15), 0.1 + 0.2001 * (i % 3));
    boxes.push_back(
        world.only_link(world.add(box_model("b" + std::to_string(i), 3.0, {0.3, 0.3, 0.2}, at))));
  }
  world.run(0.3);
  std::vector<Vec3> start;
  for (const LinkId box : boxes) start.push_back(world.link(box).pose.position);
  world.run(59.7);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    EXPECT_LT((world.link(boxes[i]).pose.position - start[i]).norm(), 1e-4) << i;
  }
  EXPECT_EQ(world.awake_count(), 0U);
  EXPECT_EQ(world.failed_steps(), 0U);
}

// Faces that touch at a depth of exactly 0 are where ODE's first solver is known to give up.
TEST(World, BoxesStackedExactlyComeToRestAlthoughASolverFails) {
  TestWorld world;
  world.add(floor_model());
  std::vector<LinkId> boxes;
  for (int i = 0; i < 3; ++i) {
    boxes.push_back(world.only_link(world.add(
        box_model("b" + std::to_string(i), 3.0, {0.3, 0.3, 0.2}, {0, 0, 0.1 + 0.2 * i}))));
  }
  world.run(2.0);
  EXPECT_LE(world.failed_steps(), 1U);
  EXPECT_EQ(world.awake_count(), 0U);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(world.link(boxes[i]).pose.position.z(), 0.1 + 0.2 * i, 1e-4);
  }
  EXPECT_NEAR(force_on(world, "floor::link::collision").z(), -9.0 * 9.81, 0.5);
}

TEST(World, ThinWallsStopWhatIsSlowerThanTwoMetresASecond) {
  for (const auto type :
       {Shape::Type::kBox, Shape::Type::kSphere, Shape::Type::kCylinder, Shape::Type::kCapsule}) {
    TestWorld world({}, Vec3::Zero());
    world.add(static_box("wall", {0.01, 4, 4}, {1, 0, 0}));
    desc::Model bullet = box_model("bullet", 2.0, {0.1, 0.1, 0.1});
    if (type != Shape::Type::kBox)
      bullet.links[0].collisions[0].shape = round_shape(type, 0.05, 0.1);
    const LinkId link = world.only_link(world.add(bullet));
    world.drive(link, {2.0, 0, 0}, 0.0, 1e4);
    world.run(0.1);
    world.drive(link, Vec3::Zero(), 0.0, 0.0);
    ASSERT_NEAR(world.link(link).linear_velocity.x(), 2.0, 1e-3);
    world.run(2.0);
    EXPECT_LT(world.link(link).pose.position.x(), 0.96) << static_cast<int>(type);
  }
}

TEST(World, ModelsCollideWithThemselvesOnlyWhenTold) {
  for (const bool self : {false, true}) {
    TestWorld world({}, Vec3::Zero());
    desc::Model model =
        model_of("m", {box_link("a", 1, {1, 1, 1}),
                       box_link("b", 1, {1, 1, 1}, {{0.9, 0, 0}, Quat::Identity()}),
                       box_link("c", 1, {1, 1, 1}, {{0, 0.9, 0}, Quat::Identity()})});
    model.joints = {joint_of(desc::Joint::Type::kPrismatic, "a", "b")};
    model.self_collide = self;
    world.add(model);
    world.run(kStep);
    const std::size_t pairs = self ? 2 : 0;  // a-c and b-c, never a-b
    EXPECT_EQ(world.contacts().size(), pairs);
  }
}

TEST(World, MovedNamesWhatMovedAndNothingElse) {
  TestWorld world;
  world.add(floor_model());
  const ModelId box = world.add(box_model("box", 1, {0.2, 0.2, 0.2}, {0, 0, 1}));
  const ModelId door = world.add(door_model("door", {3, 0, 0}));
  world.run(1.5);
  ASSERT_FALSE(world.awake(world.links(door)[1]));
  world.move(box, {{0, 0, 0.9}, Quat::Identity()});
  ASSERT_EQ(world.moved().size(), 1U);
  world.run(kStep);
  ASSERT_EQ(world.moved().size(), 1U);
  EXPECT_EQ(world.moved()[0], world.only_link(box));
}

TEST(World, StaleIdsAreRejected) {
  TestWorld world;
  const ModelId box = world.add(box_model("box", 1, {0.2, 0.2, 0.2}));
  const LinkId link = world.only_link(box);
  world.remove(box);
  EXPECT_THROW(world.link(link), std::out_of_range);
  EXPECT_THROW(world.remove(box), std::out_of_range);
  world.add(box_model("box", 1, {0.2, 0.2, 0.2}));
  EXPECT_THROW(world.link(link), std::out_of_range);
}

TEST(World, AddingAndRemovingBetweenStepsLeavesNothing) {
  TestWorld world;
  world.add(floor_model());
  for (int i = 0; i < 200; ++i) {
    const ModelId door = world.add(door_model("door", {0, 0, 0}));
    const ModelId robot = world.add(robot_model("robot", {2, 0, 0}));
    world.run(2 * kStep);
    world.remove(door);
    world.remove(robot);
  }
  EXPECT_EQ(world.awake_count(), 0U);
  EXPECT_TRUE(world.contacts().empty());
}

}  // namespace
}  // namespace angen::physics::testing

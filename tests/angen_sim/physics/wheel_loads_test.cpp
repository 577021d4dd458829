// Loads of wheels that statics alone does not give.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "models.h"

namespace angen::physics::testing {
namespace {

using Type = desc::Joint::Type;

constexpr double kRim = 0.04;  // m, radius of a wheel
enum class Steering { kFree, kHeld, kDriven };

/// Symmetric, with four wheels; each of the front ones sits `beside` its steering hinge. Its first
/// two joints are the hinges.
desc::Model steered_cart(double beside, double damping) {
  const Vec3 front(0.2, 0.15, kRim), back(-0.2, 0.15, kRim);
  std::vector<desc::Link> links{
      ghost_link("body", 0.2, {0.5, 0.3, 0.1}, {{0, 0, kRim + 0.05}, Quat::Identity()})};
  std::vector<desc::Joint> hinges, axles;
  const auto add_wheel = [&](const std::string& name, const Vec3& at, const std::string& parent) {
    desc::Link wheel;
    wheel.name = name;
    wheel.pose = {at, from_rpy(-M_PI / 2, 0, 0)};
    wheel.inertial = box_inertial(0.3, {0.06, 0.06, 0.03});
    wheel.collisions.push_back(collision(round_shape(Shape::Type::kCylinder, kRim, 0.02)));
    links.push_back(wheel);
    axles.push_back(joint_of(Type::kRevolute, parent, name, Vec3::UnitY(), at));
  };
  for (const double side : {1.0, -1.0}) {
    const std::string name = side > 0 ? "left" : "right";
    const Vec3 turn(1.0, side, 1.0);
    add_wheel("rear_" + name, back.cwiseProduct(turn), "body");
    const Vec3 hinge = front.cwiseProduct(turn) - Vec3(0, side * beside, 0);
    links.push_back(
        ghost_link("knuckle_" + name, 0.1, {0.03, 0.03, 0.03}, {hinge, Quat::Identity()}));
    hinges.push_back(joint_of(Type::kRevolute, "body", "knuckle_" + name, Vec3::UnitZ(), hinge));
    hinges.back().axes[0].damping = damping;
    hinges.back().axes[0].lower = -0.6;
    hinges.back().axes[0].upper = 0.6;
    add_wheel(name, front.cwiseProduct(turn), "knuckle_" + name);
  }
  desc::Model model = model_of("cart", links);
  model.joints = hinges;
  model.joints.insert(model.joints.end(), axles.begin(), axles.end());
  return model;
}

double load(const World& world, const std::string& wheel) {
  return force_on(world, "cart::" + wheel + "::collision").z();
}

/// The greatest difference of the front loads by their sum, while 5 N pull for 1 s.
double worst_difference(double beside, Steering steering) {
  TestWorld world;
  world.add(floor_model());
  const ModelId id = world.add(steered_cart(beside, steering == Steering::kFree ? 0.1 : 0.0));
  const LinkId body = world.links(id)[0];
  const auto steer = [&](double speed) {
    for (int i : {0, 1}) world.set_motor(world.joints(id)[i], speed, 10.0);
  };
  if (steering != Steering::kFree) steer(0.0);
  world.run(0.5);
  double worst = 0.0;
  for (int i = 0; i < 1000; ++i) {
    world.push(body, {5, 0, 0}, Vec3::Zero(), world.link(body).pose.position);
    if (steering == Steering::kDriven) steer(0.3 * std::cos(0.006 * i));
    world.run(kStep);
    const double left = load(world, "left"), right = load(world, "right");
    if (i > 50) worst = std::max(worst, std::abs(left - right) / (left + right));
  }
  return worst;
}

TEST(WheelLoads, OfASymmetricCartStayEqual) {
  for (const Steering steering : {Steering::kFree, Steering::kHeld, Steering::kDriven}) {
    double worst = 0.0;
    for (const double beside : {0.005, 0.0225, 0.05}) {
      worst = std::max(worst, worst_difference(beside, steering));
    }
    printf("steering %d: front loads differ by at most %.2f %% of their sum\n",
           static_cast<int>(steering), 100 * worst);
    EXPECT_LT(worst, 0.04);
  }
}

TEST(WheelLoads, AreThoseOfEqualSpringsUnderALoadBesideTheMiddle) {
  TestWorld world;
  world.add(floor_model());
  desc::Model model = steered_cart(0.0, 0.0);
  const double mass = 10.0, x = 0.08, y = 0.05;
  model.links[0].inertial = box_inertial(mass, {0.5, 0.3, 0.1}, {{x, y, 0.0}, Quat::Identity()});
  const ModelId id = world.add(model);
  for (int i : {0, 1}) world.set_motor(world.joints(id)[i], 0.0, 10.0);
  world.run(1.0);
  // Four equal springs at (+-0.2, +-0.15): each load is linear in the place.
  const auto expected = [&](double front, double left) {
    const double knuckle = front > 0.0 ? 0.1 * 9.81 : 0.0;
    return 0.3 * 9.81 + knuckle + mass * 9.81 / 4 * (1 + front * x / 0.2 + left * y / 0.15);
  };
  EXPECT_NEAR(load(world, "left"), expected(1, 1), 0.02 * expected(1, 1));
  EXPECT_NEAR(load(world, "right"), expected(1, -1), 0.02 * expected(1, -1));
  EXPECT_NEAR(load(world, "rear_left"), expected(-1, 1), 0.02 * expected(1, 1));
  EXPECT_NEAR(load(world, "rear_right"), expected(-1, -1), 0.02 * expected(1, 1));
}

}  // namespace
}  // namespace angen::physics::testing

#include "physics/gyroscopic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "models.h"

namespace angen::physics::testing {
namespace {

constexpr double kEarth = 9.81;

struct Spin {
  Vec3 momentum;
  double energy;
};

Spin spin_of(const World& world, LinkId link, const Eigen::Matrix3d& moment) {
  const LinkState state = world.link(link);
  const Vec3 own = state.pose.rotation.conjugate() * state.angular_velocity;
  return {state.pose.rotation * (moment * own), 0.5 * own.dot(moment * own)};
}

/// Euler's equations without torques, by Runge and Kutta's fourth order.
Vec3 free_spin_after(const Eigen::Matrix3d& moment, Vec3 spin, double seconds) {
  const double step = 1e-4;
  const auto rate = [&](const Vec3& w) { return Vec3(moment.inverse() * (moment * w).cross(w)); };
  for (int i = 0; i < std::lround(seconds / step); ++i) {
    const Vec3 a = rate(spin), b = rate(spin + step / 2 * a), c = rate(spin + step / 2 * b),
               d = rate(spin + step * c);
    spin += step / 6 * (a + 2 * b + 2 * c + d);
  }
  return spin;
}

class Gyroscopic : public ::testing::TestWithParam<double> {};

TEST_P(Gyroscopic, AFreeBodyKeepsItsMomentumAndItsEnergy) {
  TestWorld world({}, Vec3::Zero());
  const desc::Model model = box_model("box", 2.0, {0.1, 0.2, 0.4});
  const Eigen::Matrix3d moment = model.links[0].inertial.moment;
  const LinkId link = world.only_link(world.add(model));
  world.set_velocity(link, Vec3::Zero(), GetParam() * Vec3(1e-3, 1.0, 0.0));  // the middle axis
  const Spin start = spin_of(world, link, moment);
  double gained = 0.0;
  double turned = 0.0;
  for (int i = 0; i < 400; ++i) {
    world.run(0.05);
    const Spin now = spin_of(world, link, moment);
    gained = std::max(gained, std::abs(now.energy / start.energy - 1.0));
    turned = std::max(turned, (now.momentum - start.momentum).norm() / start.momentum.norm());
  }
  printf("%g rad/s for 20 s: energy within %.4f %%, momentum within %.3f %%\n", GetParam(),
         100 * gained, 100 * turned);
  EXPECT_LT(gained, 0.001);
  // A spin is that between two ticks, the pose that at a tick.
  EXPECT_LT(turned, 0.5 * kStep * GetParam());
}

INSTANTIATE_TEST_SUITE_P(RadPerSecond, Gyroscopic, ::testing::Values(3.0, 10.0, 100.0));

TEST(GyroscopicTorque, TumblesAsEulersEquationsSay) {
  TestWorld world({}, Vec3::Zero());
  const desc::Model model = box_model("box", 2.0, {0.1, 0.2, 0.4});
  const LinkId link = world.only_link(world.add(model));
  const Vec3 spin(1.0, 10.0, 0.5);
  world.set_velocity(link, Vec3::Zero(), spin);
  for (int i = 1; i <= 20; ++i) {
    world.run(0.1);
    const LinkState state = world.link(link);
    const Vec3 own = state.pose.rotation.conjugate() * state.angular_velocity;
    const Vec3 exact = free_spin_after(model.links[0].inertial.moment, spin, 0.1 * i - kStep / 2);
    EXPECT_LT((own - exact).norm(), 0.01 * spin.norm()) << i;
  }
}

/// A disc of 1 kg on a weightless rod that stands on its tip: the angle by which its axis dips when
/// it is let go, and how much energy it loses in 20 s.
TEST(GyroscopicTorque, ATopDipsAsTheIntegralsOfItsMotionSay) {
  const double l = 0.1, r = 0.1, spin = 100.0, tilt = 0.5;
  const double axial = r * r / 2, across = r * r / 4;
  desc::Link link;
  link.name = "top";
  link.inertial.mass = 1.0;
  link.inertial.moment = Vec3(across, across, axial).asDiagonal();
  link.inertial.pose.position = {0, 0, l};
  desc::Model model = model_of("top", {link}, {Vec3::Zero(), from_rpy(tilt, 0, 0)});
  model.joints = {joint_of(desc::Joint::Type::kBall, "world", "top")};
  TestWorld world;
  const LinkId top = world.only_link(world.add(model));
  world.set_velocity(top, Vec3::Zero(), from_rpy(tilt, 0, 0) * Vec3(0, 0, spin));
  double lowest = tilt;
  const auto energy = [&] {
    const LinkState state = world.link(top);
    const Vec3 own = state.pose.rotation.conjugate() * state.angular_velocity;
    const Vec3 moments(across + l * l, across + l * l, axial);
    return 0.5 * own.dot(moments.cwiseProduct(own)) +
           kEarth * l * (state.pose.rotation * Vec3::UnitZ()).z();
  };
  const double before = energy();
  for (int i = 0; i < 20000; ++i) {
    world.run(kStep);
    lowest = std::max(lowest, std::acos((world.link(top).pose.rotation * Vec3::UnitZ()).z()));
  }
  // Momenta about the vertical and its own axis, and the energy, are kept: with u = cos tilt,
  // 2 m g l (u0 - u) (1 - u^2) (I + m l^2) = (L (u0 - u))^2, a quadratic equation besides u = u0.
  const double u0 = std::cos(tilt);
  const double p = std::pow(axial * spin, 2) / (4 * kEarth * l * (across + l * l));
  const double exact = std::acos(p - std::sqrt(p * p - 2 * p * u0 + 1.0)) - tilt;
  printf("a top dips by %.4f rad, exact %.4f, and gains %.4f %% of energy in 20 s\n", lowest - tilt,
         exact, 100 * (energy() / before - 1.0));
  EXPECT_NEAR(lowest - tilt, exact, 0.01 * exact);
  EXPECT_NEAR(energy(), before, 0.005 * before);
}

/// A rotor on a hinge in a frame on a ball joint, let go with a level axis: how far it dips.
TEST(GyroscopicTorque, ARotorOnAHingeDipsAsATopDoesAndNoDeeperLater) {
  const double l = 0.3, axial = 0.02, across = 0.011;
  desc::Link frame, rotor;
  frame.name = "frame";
  frame.inertial.mass = 0.05;
  frame.inertial.moment = 1e-3 * Eigen::Matrix3d::Identity();
  frame.inertial.pose.position = {l / 2, 0, 0};
  rotor.name = "rotor";
  rotor.inertial.mass = 1.0;
  rotor.inertial.moment = Vec3(axial, across, across).asDiagonal();
  rotor.inertial.pose.position = {l, 0, 0};
  desc::Model model = model_of("gyroscope", {frame, rotor});
  model.joints = {joint_of(desc::Joint::Type::kBall, "world", "frame"),
                  joint_of(desc::Joint::Type::kRevolute, "frame", "rotor", Vec3::UnitX())};
  for (const double spin : {100.0, 200.0}) {
    TestWorld world;
    const LinkId link = world.links(world.add(model)).at(1);
    world.set_velocity(link, Vec3::Zero(), Vec3(spin, 0, 0));
    // The equation of the top above, with u0 = 0, for both bodies.
    const double torque = kEarth * (rotor.inertial.mass * l + frame.inertial.mass * l / 2);
    const double moment =
        across + rotor.inertial.mass * l * l + 1e-3 + frame.inertial.mass * l * l / 4;
    const double p = std::pow(axial * spin, 2) / (4 * torque * moment);
    const double exact = std::sqrt(p * p + 1.0) - p;
    for (int second = 1; second <= 4; ++second) {
      double lowest = 0.0;
      for (int i = 0; i < 1000; ++i) {
        world.run(kStep);
        lowest = std::max(lowest, -(world.link(link).pose.rotation * Vec3::UnitX()).z());
      }
      EXPECT_NEAR(lowest, exact, 0.01 * exact) << spin << " rad/s, second " << second;
    }
  }
}

class Joined : public ::testing::TestWithParam<double> {};

/// Two boxes on a hinge float free: together they keep their momentum and energy.
TEST_P(Joined, BoxesOnAHingeKeepTheirMomentumAndTheirEnergy) {
  const Vec3 size(0.1, 0.2, 0.4);
  const double masses[] = {2.0, 1.0};
  desc::Model model =
      model_of("pair", {ghost_link("a", masses[0], size, {{-0.1, 0, 0}, Quat::Identity()}),
                        ghost_link("b", masses[1], size, {{0.2, 0, 0}, Quat::Identity()})});
  model.joints = {joint_of(desc::Joint::Type::kRevolute, "a", "b", Vec3(1, 1, 1).normalized())};
  TestWorld world({}, Vec3::Zero());
  const std::vector<LinkId> links = world.links(world.add(model));
  const Vec3 spin = GetParam() * Vec3(0.3, 1.0, 0.2).normalized();
  for (const LinkId link : links) {  // their center is the origin
    world.set_velocity(link, spin.cross(world.pose(link).position), spin);
  }
  const auto both = [&] {
    Spin sum{Vec3::Zero(), 0.0};
    for (std::size_t i = 0; i < links.size(); ++i) {
      const LinkState state = world.link(links[i]);
      const Spin one = spin_of(world, links[i], model.links[i].inertial.moment);
      sum.momentum += one.momentum + masses[i] * state.pose.position.cross(state.linear_velocity);
      sum.energy += one.energy + 0.5 * masses[i] * state.linear_velocity.squaredNorm();
    }
    return sum;
  };
  const Spin start = both();
  double gained = 0.0;
  double turned = 0.0;
  for (int i = 0; i < 1000; ++i) {
    world.run(0.01);
    gained = std::max(gained, std::abs(both().energy / start.energy - 1.0));
    turned = std::max(turned, (both().momentum - start.momentum).norm() / start.momentum.norm());
  }
  printf("%g rad/s for 10 s: energy within %.4f %%, momentum within %.3f %%\n", GetParam(),
         100 * gained, 100 * turned);
  EXPECT_LT(gained, 0.001);
  EXPECT_LT(turned, kStep * GetParam());
}

INSTANTIATE_TEST_SUITE_P(RadPerSecond, Joined, ::testing::Values(3.0, 8.0, 20.0));

}  // namespace
}  // namespace angen::physics::testing

#include <gtest/gtest.h>

#include <cmath>

#include "robot.h"

namespace angen::physics::testing {
namespace {

constexpr double kG = 9.81;
constexpr int kDirections = 16;

double azimuth(int i) { return 2.0 * M_PI * i / kDirections; }
Vec3 heading(double a) { return {std::cos(a), std::sin(a), 0.0}; }

/// Gravity as on a slope that falls towards an azimuth.
Vec3 on_slope(double slope, double towards) {
  return kG * (std::sin(slope) * heading(towards) - std::cos(slope) * Vec3::UnitZ());
}

/// A wheel on its rim that is blocked and stays upright.
desc::Model blocked_wheel(double mu) {
  desc::Link link;
  link.name = "link";
  link.upright = true;
  link.pose = {{0, 0, 0.1}, from_rpy(-M_PI / 2, 0, 0)};
  link.inertial = box_inertial(2.0, {0.2, 0.2, 0.05});
  link.collisions.push_back(collision(round_shape(Shape::Type::kCylinder, 0.1, 0.05), mu));
  return model_of("wheel", {link});
}

desc::Model crate(double mu) { return box_model("crate", 20.0, {0.5, 0.4, 0.1}, {0, 0, 0.05}, mu); }

class Slides : public ::testing::TestWithParam<bool> {
 protected:
  static desc::Model model(double mu) { return GetParam() ? blocked_wheel(mu) : crate(mu); }
};

TEST_P(Slides, AsCoulombSaysWhereverTheSlopeFalls) {
  const double mu = 0.4;
  const double slope = 25.0 * M_PI / 180.0;
  const double exact = kG * (std::sin(slope) - mu * std::cos(slope));
  double worst = 0.0;
  double aside = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    TestWorld world({}, on_slope(slope, azimuth(i)));
    world.add(floor_model(mu));
    const LinkId link = world.only_link(world.add(model(mu)));
    world.run(0.2);
    const Vec3 before = world.link(link).linear_velocity;
    world.run(1.0);
    const Vec3 gained = world.link(link).linear_velocity - before;
    worst = std::max(worst, std::abs(gained.dot(heading(azimuth(i))) / exact - 1.0));
    aside = std::max(aside, std::abs(gained.dot(heading(azimuth(i) + M_PI / 2))) / exact);
  }
  printf("slides down 16 slopes with an error of at most %.3f %%, %.3f %% aside\n", 100 * worst,
         100 * aside);
  EXPECT_LT(worst, 0.02);
  EXPECT_LT(aside, 0.02);
}

TEST_P(Slides, FromTheSameSlopeOnInEachDirection) {
  const double mu = 0.4;
  double farthest = 0.0;
  double shortest = 1e9;
  for (int i = 0; i < kDirections; ++i) {
    for (const double share : {0.98, 1.02}) {
      const double slope = std::atan(share * mu);
      TestWorld world({}, on_slope(slope, azimuth(i)));
      world.add(floor_model(mu));
      const LinkId link = world.only_link(world.add(model(mu)));
      world.run(0.2);
      const Vec3 before = world.link(link).pose.position;
      world.run(1.0);
      const double way = (world.link(link).pose.position - before).norm();
      if (share < 1.0) farthest = std::max(farthest, way);
      if (share > 1.0) shortest = std::min(shortest, way);
    }
  }
  printf("2 %% below the limit it slides at most %.2e m, 2 %% above at least %.4f m\n", farthest,
         shortest);
  EXPECT_LT(farthest, 1e-4);
  EXPECT_GT(shortest, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Friction, Slides, ::testing::Bool(),
                         [](const auto& each) { return each.param ? "Wheel" : "Crate"; });

// v' = g_t - mu g_n v / |v|, by small steps.
Vec3 slid(Vec3 v, const Vec3& pull, double brake, double seconds) {
  const int n = 200000;
  const double h = seconds / n;
  Vec3 way = Vec3::Zero();
  for (int i = 0; i < n; ++i) {
    way += 0.5 * h * v;
    v += h * (pull - brake * v.normalized());
    way += 0.5 * h * v;
  }
  return way;
}

TEST(Friction, BendsThePathOfWhatIsThrownAcrossASlope) {
  const double mu = 0.4;
  const double slope = 20.0 * M_PI / 180.0;
  double worst = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    const Vec3 gravity = on_slope(slope, azimuth(i));
    TestWorld world({}, gravity);
    world.add(floor_model(mu));
    const LinkId link = world.only_link(world.add(crate(mu)));
    world.run(0.1);
    const Vec3 thrown = 2.0 * heading(azimuth(i) + M_PI / 2);
    world.push(link, 20.0 / kStep * thrown, Vec3::Zero(), world.link(link).pose.position);
    world.run(kStep);
    const LinkState start = world.link(link);
    world.run(0.4);
    const Vec3 pull(gravity.x(), gravity.y(), 0.0);
    const Vec3 v(start.linear_velocity.x(), start.linear_velocity.y(), 0.0);
    const Vec3 exact = slid(v, pull, mu * -gravity.z(), 0.4);
    const Vec3 way = world.link(link).pose.position - start.pose.position;
    worst = std::max(worst, (way - exact).head<2>().norm() / exact.norm());
  }
  printf("thrown across 16 slopes it ends at most %.3f %% of its way off\n", 100 * worst);
  EXPECT_LT(worst, 0.02);
}

// The force is at the floor's height, so that no wheel is relieved; the load of the wheels is
// measured.
TEST(Friction, OfTheWheelsOfARobotThatBrakesIsTheSameInEachDirection) {
  const double mu = 0.4;
  double least = 1e9;
  double most = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    TestWorld world;
    world.add(floor_model(mu));
    const ModelId robot = world.add(robot_model("robot"));
    const LinkId base = world.links(robot)[0];
    for (const JointId wheel : world.joints(robot)) world.set_motor(wheel, 0.0, 100.0);
    world.run(0.3);
    const Vec3 at = world.link(base).pose.position;
    double pressed = 0.0;
    double force = 0.0;
    const auto moved = [&] { return (world.link(base).pose.position - at).head<2>().norm(); };
    while (moved() < 1e-4 && force < 100.0) {
      pressed = force_on(world, "robot::left_wheel::collision").z() +
                force_on(world, "robot::right_wheel::collision").z();
      force = std::max(force + 0.0005, 0.95 * mu * pressed);
      const Vec3 point(world.link(base).pose.position.x(), world.link(base).pose.position.y(), 0.0);
      world.push(base, force * heading(azimuth(i)), Vec3::Zero(), point);
      world.run(kStep);
    }
    least = std::min(least, force / pressed);
    most = std::max(most, force / pressed);
  }
  printf("wheels hold against %.4f to %.4f of their load, mu = %.1f\n", least, most, mu);
  EXPECT_GT(least, 0.98 * mu);
  EXPECT_LT(most, 1.02 * mu);
}

TEST(Friction, OfAPersonWhoStandsIsTheSameInEachDirection) {
  double farthest = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    for (const double share : {0.97, 1.03}) {
      TestWorld world;
      world.add(floor_model());
      const LinkId body = world.only_link(world.add(person_model("person", {0, 0, 0.001})));
      world.drive(body, Vec3::Zero(), 0.0, 150.0);
      world.run(0.2);
      const Vec3 at = world.link(body).pose.position;
      for (int k = 0; k < 500; ++k) {
        world.push(body, share * 150.0 * heading(azimuth(i)), Vec3::Zero(),
                   world.link(body).pose.position);
        world.run(kStep);
      }
      const double way = (world.link(body).pose.position - at).head<2>().norm();
      EXPECT_EQ(way > 1e-3, share > 1.0) << i << ": " << way;
      farthest = std::max(farthest, share < 1.0 ? way : 0.0);
    }
  }
  printf("pushed with 3 %% less than its force a person gives way by %.1e m\n", farthest);
  EXPECT_LT(farthest, 1e-4);
}

}  // namespace
}  // namespace angen::physics::testing

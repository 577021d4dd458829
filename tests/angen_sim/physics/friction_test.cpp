#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/random.h"
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
  link.anatomy.upright = true;
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

struct Runners {
  double uphill;       // coefficients of friction
  double downhill;     // across the slope
  double height;       // height of the center of mass, in distances of the runners
  bool laden = false;  // a small box, of 1 % of its mass, lies on it
};

/// A frame on two runners across the slope, which falls towards x.
desc::Model frame_model(const Runners& runners) {
  const double apart = 0.5;
  desc::Link link;
  link.name = "link";
  link.inertial =
      box_inertial(10.0, {0.4, 0.4, 0.4}, {{0, 0, runners.height * apart}, Quat::Identity()});
  for (const bool uphill : {true, false}) {
    link.collisions.push_back(
        collision(box_shape({0.01, 0.4, 0.02}), uphill ? runners.uphill : runners.downhill,
                  {{(uphill ? -0.5 : 0.5) * apart, 0, 0.01}, Quat::Identity()}));
    link.collisions.back().name = uphill ? "uphill" : "downhill";
  }
  link.collisions.push_back(
      collision(box_shape({0.2, 0.2, 0.02}), 10.0, {{0, 0, 0.05}, Quat::Identity()}));
  return model_of("frame", {link});
}

struct Point {
  double pressed = 0.0;   // N
  double friction = 0.0;  // N
};

/// The contact points of collisions with `part` in their name.
std::vector<Point> points_of(const World& world, const std::string& part) {
  std::vector<Point> points;
  for (const ContactPair& pair : world.contacts()) {
    if (pair.second.find(part) == std::string::npos) continue;
    for (const ContactPoint& point : pair.points) {
      const double pressed = point.normal.dot(point.force);
      points.push_back({std::abs(pressed), (point.force - pressed * point.normal).norm()});
    }
  }
  return points;
}

/// The greatest share of Coulomb's bound among points that carry more than 1 mN.
double greatest_share(const World& world, const std::string& part, double mu) {
  double most = 0.0;
  for (const Point& point : points_of(world, part)) {
    if (point.friction > 1e-3) most = std::max(most, point.friction / (mu * point.pressed));
  }
  return most;
}

class Frame : public ::testing::TestWithParam<Runners> {};

// The friction T shifts h T / L of the load downhill: T = mu N with N = W cos a / 2 -+ h T / L.
TEST_P(Frame, SlidesFromTheSlopeOnThatStaticsGives) {
  const Runners& r = GetParam();
  const double limit =
      std::atan((r.uphill + r.downhill) / 2.0 / (1.0 + r.height * (r.uphill - r.downhill)));
  for (const double beyond : {-5.0, -0.5, 0.5, 4.0, 10.0}) {
    TestWorld world({}, on_slope(limit + beyond * M_PI / 180.0, 0.0));
    world.add(floor_model(10.0));
    const LinkId link = world.only_link(world.add(frame_model(r)));
    if (r.laden) world.add(box_model("load", 0.1, {0.1, 0.1, 0.02}, {0, 0, 0.07}, 10.0));
    world.run(0.3);
    const Vec3 at = world.link(link).pose.position;
    double share = 0.0;
    for (int i = 0; i < 400; ++i) {
      world.run(kStep);
      if (r.uphill > 0.0) share = std::max(share, greatest_share(world, "uphill", r.uphill));
      if (r.downhill > 0.0) share = std::max(share, greatest_share(world, "downhill", r.downhill));
    }
    const double way = (world.link(link).pose.position - at).norm();
    EXPECT_EQ(way > 1e-3, beyond > 0.0) << beyond << " degrees beyond: " << way << " m";
    EXPECT_LT(share, 1.02) << beyond << " degrees beyond";
  }
}

INSTANTIATE_TEST_SUITE_P(Friction, Frame,
                         ::testing::Values(Runners{0.8, 0.0, 1.0}, Runners{0.0, 0.5, 1.0},
                                           Runners{0.8, 0.0, 0.5}, Runners{0.0, 0.8, 0.5},
                                           Runners{0.3, 0.6, 0.7}, Runners{1.2, 0.0, 1.5},
                                           Runners{0.8, 0.0, 1.0, true},
                                           Runners{0.0, 0.5, 1.0, true}));

// On balls of the radius r: W / 2 cos a = T (sin a - r / l), with T = mu W at the limit.
TEST(Friction, HoldsALadderAtASmoothWallFromTheAngleOfStaticsOn) {
  const double length = 3.0;
  const double radius = 0.01;
  for (const double mu : {0.3, 0.5, 0.8}) {
    double limit = 0.0;
    while (0.5 * std::cos(limit) > mu * (std::sin(limit) - radius / length)) limit += 1e-5;
    for (const double beyond : {-0.5, 0.5}) {
      const double angle = limit + beyond * M_PI / 180.0;
      desc::Link link;
      link.name = "link";
      link.inertial = box_inertial(10.0, {length, 0.4, 0.02});
      for (const double side : {-0.2, 0.2}) {
        for (const double end : {-0.5, 0.5}) {
          link.collisions.push_back(collision(round_shape(Shape::Type::kSphere, radius),
                                              end > 0 ? 0.0 : mu,
                                              {{end * length, side, 0}, Quat::Identity()}));
          link.collisions.back().name = (end > 0 ? "top" : "foot") + std::to_string(side);
        }
      }
      const Vec3 center(-0.5 * length * std::cos(angle) - radius, 0,
                        0.5 * length * std::sin(angle) + radius);
      TestWorld world;
      world.add(floor_model(10.0));
      world.add(static_box("wall", {0.2, 4.0, 8.0}, {0.1, 0, 0}, 10.0));
      const LinkId ladder =
          world.only_link(world.add(model_of("ladder", {link}, {center, from_rpy(0, -angle, 0)})));
      world.run(0.5);
      const double way = (world.link(ladder).pose.position - center).norm();
      EXPECT_EQ(way<1e-3, beyond> 0.0) << mu << ", " << beyond << " degrees: " << way << " m";
      EXPECT_LT(greatest_share(world, "foot", mu), 1.02);
    }
  }
}

// Boxes at rest, pushed, thrown and turned on slopes, from 20 ms after their start on.
TEST(Friction, StaysWithinCoulombsLawAtTenThousandRandomPoints) {
  Rng random(7, 1, 0);
  const auto draw = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  int points = 0;
  int slide = 0;
  double worst = 0.0;
  for (int k = 0; points < 10000; ++k) {
    const double mu = draw(0.1, 1.2);
    const Vec3 size(draw(0.2, 1.0), draw(0.2, 1.0), draw(0.05, 1.0));
    const double mass = draw(1.0, 50.0);
    TestWorld world({}, on_slope(draw(0.0, 0.5), draw(0.0, 6.28)));
    world.add(floor_model(10.0));
    const LinkId link =
        world.only_link(world.add(box_model("box", mass, size, {0, 0, 0.5 * size.z()}, mu)));
    world.run(0.02);
    if (k % 3 != 0) {
      world.set_velocity(link, {draw(-2, 2), draw(-2, 2), 0.0}, {0, 0, draw(-4, 4)});
    }
    const Vec3 push = 0.6 * mu * mass * kG * Vec3(draw(-1, 1), draw(-1, 1), 0.0);
    const Vec3 lever = size.cwiseProduct(Vec3(draw(-0.5, 0.5), draw(-0.5, 0.5), draw(-0.5, 0.5)));
    for (int i = 0; i < 200; ++i) {
      world.push(link, push, Vec3::Zero(), world.link(link).pose * lever);
      world.run(kStep);
      if (i < 20 || i % 20 != 0) continue;
      const bool slides = world.link(link).linear_velocity.norm() > 1e-3;
      for (const Point& point : points_of(world, "box")) {
        if (point.pressed < 1e-3) continue;
        ++points;
        slide += slides ? 1 : 0;
        worst = std::max(worst, point.friction / (mu * point.pressed));
      }
    }
  }
  printf("%d points, %d of them slide, at most %.3f of Coulomb's bound\n", points, slide, worst);
  EXPECT_GT(slide, points / 4);
  EXPECT_LT(worst, 1.02);
}

// Boxes jammed in a pit, whose bounds of friction never agree, fall asleep.
TEST(Friction, LetsHeapsInPitsSleep) {
  for (const int seed : {1, 2, 3, 4}) {
    Rng random(seed, 5, 0);
    const auto draw = [&](double most) { return most * (2.0 * random.uniform() - 1.0); };
    TestWorld world;
    world.add(floor_model(10.0));
    for (const double side : {-0.45, 0.45}) {
      const std::string name = std::to_string(side);
      world.add(static_box("x" + name, {0.2, 3.0, 6.0}, {side, 0, 3}, 10.0));
      world.add(static_box("y" + name, {3.0, 0.2, 6.0}, {0, side, 3}, 10.0));
    }
    for (int i = 0; i < 6; ++i) {
      const double x = draw(0.1), y = draw(0.1), roll = draw(1.0), pitch = draw(1.0);
      desc::Model box =
          box_model("box" + std::to_string(i), 5.0, {0.3, 0.3, 0.3}, {x, y, 0.4 + 0.55 * i}, 0.6);
      box.pose.rotation = from_rpy(roll, pitch, draw(3.0));
      world.add(box);
    }
    for (int step = 0; step < 5000 && world.awake_count() > 0; ++step) world.run(kStep);
    EXPECT_EQ(world.awake_count(), 0U) << "seed " << seed;
  }
}

}  // namespace
}  // namespace angen::physics::testing

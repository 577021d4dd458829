#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "angen_sim/devices/models.h"
#include "angen_sim/devices/rig.h"

namespace angen::test {
namespace {

struct Field {
  Bench bench;
  Rig* rig = nullptr;

  explicit Field(const Parameters& parameters = {}) {
    bench.add(ground());
    rig = &bench.add(robot({0, 0, 0}), "librobot_controller.so", "drive", parameters);
    bench.run(1.0);
  }
  /// Commands at 10 Hz for that many seconds, then stops.
  void drive(double v, double w, double seconds) {
    for (int i = 0; i < std::lround(10 * seconds); ++i) {
      rig->command(v, w);
      bench.run(0.1);
    }
    rig->command(0.0, 0.0);
    bench.run(2.0);
  }
  double get(const char* name) const { return rig->state().get<double>(name); }
};

TEST(Drive, DrivesTwoMetresStraight) {
  Field field;
  const Vec3 start = field.rig->body("base").pose.position;
  field.drive(0.4, 0.0, 5.0);
  const Vec3 went = field.rig->body("base").pose.position - start;
  // Ramps up at 1 m/s^2 for 0.4 s and down again: the way is that of the command's rectangle.
  printf("drive straight: went %.4f m, aside %.5f m, odom %.4f m\n", went.x(), went.y(),
         field.get("x"));
  EXPECT_NEAR(went.x(), 2.0, 0.02);
  EXPECT_NEAR(went.y(), 0.0, 0.01);
  EXPECT_NEAR(field.get("x"), went.x(), 0.02);
  EXPECT_NEAR(field.get("y"), went.y(), 0.01);
  EXPECT_NEAR(field.get("left"), field.get("right"), 0.02);
  EXPECT_NEAR(field.get("left") * 0.035, 2.0, 0.01);
}

TEST(Drive, TurnsOnTheSpotByTheClosedForm) {
  Field field;
  const double start = yaw_of(field.rig->body("base").pose.rotation);
  field.drive(0.0, 1.0, 1.5);
  const double turned = yaw_of(field.rig->body("base").pose.rotation) - start;
  printf("drive turn: turned %.4f rad, odom %.4f rad\n", turned, field.get("yaw"));
  EXPECT_NEAR(field.get("yaw"), 1.5, 0.01);
  EXPECT_NEAR(turned, 1.5, 0.03);
  EXPECT_LT(field.rig->body("base").pose.position.head<2>().norm(), 0.02);
}

TEST(Drive, DrivesACircle) {
  Field field;
  const double w = 0.5;
  const double v = 0.25;
  field.drive(v, w, 2.0 * M_PI / w);
  // A full turn of radius v / w; the command lasts a whole number of tenths of a second.
  const double angle = w * std::lround(10 * 2.0 * M_PI / w) / 10.0;
  EXPECT_NEAR(field.get("x"), v / w * std::sin(angle), 0.03);
  EXPECT_NEAR(field.get("y"), v / w * (1 - std::cos(angle)), 0.03);
  const Vec3 at = field.rig->body("base").pose.position;
  printf("drive circle: body at %.3f %.3f, odom %.3f %.3f\n", at.x(), at.y(), field.get("x"),
         field.get("y"));
  EXPECT_LT(at.head<2>().norm(), 0.06);
}

TEST(Drive, KeepsItsSpeedAndAccelerationWithinLimits) {
  Field field;
  double fastest = 0.0;
  double hardest = 0.0;
  double last = 0.0;
  field.rig->command(9.0, 0.0);
  field.bench.run(0.6, [&] {
    const double v = field.rig->at("left_wheel_joint").velocity * 0.035;
    fastest = std::max(fastest, v);
    hardest = std::max(hardest, (v - last) / 0.001);
    last = v;
  });
  EXPECT_LE(fastest, 0.6 + 1e-3);
  field.rig->command(9.0, 0.0);
  field.bench.run(0.5, [&] {
    fastest = std::max(fastest, field.rig->at("left_wheel_joint").velocity * 0.035);
  });
  EXPECT_NEAR(fastest, 0.7, 1e-3);
  EXPECT_LE(hardest, 1.05);
}

TEST(Drive, KnowsItsPoseTheLessTheFartherItWent) {
  Field field;
  field.drive(0.4, 0.0, 5.0);
  const auto covariance = field.rig->state().get<std::vector<double>>("covariance");
  ASSERT_EQ(covariance.size(), 9U);
  EXPECT_NEAR(covariance[0], 1e-4 * 2.0 / 2.0, 2e-6);  // 1 cm a wheel after 1 m
  EXPECT_NEAR(covariance[8], 2e-4 * 2.0 / (0.23 * 0.23), 1e-4);
}

TEST(Drive, StopsWhenCommandsCease) {
  Field field;
  field.rig->command(0.5, 0.0);
  field.bench.run(0.5);
  EXPECT_GT(field.rig->body("base").linear_velocity.x(), 0.3);
  field.bench.run(0.7);
  EXPECT_LT(field.rig->body("base").linear_velocity.x(), 0.02);
}

TEST(Drive, StandingItBrakesSpendsNothingAndSleeps) {
  Field field;
  field.drive(0.3, 0.3, 1.0);
  field.bench.run(2.0);
  const Vec3 before = field.rig->body("base").pose.position;
  const int calls = field.rig->calls;
  field.bench.run(30.0);
  EXPECT_EQ(field.rig->calls, calls);
  EXPECT_FALSE(field.rig->body("base").awake);
  EXPECT_LT((field.rig->body("base").pose.position - before).norm(), 1e-4);
  EXPECT_EQ(field.get("v"), 0.0);
}

TEST(Drive, AWallStopsItAndItsWheelsPushNoHarderThanTheirTorque) {
  Field field;
  field.bench.add(box("wall", {0.5, 0, 0.5}, {0.1, 2, 1}));
  double push = 0.0;
  for (int i = 0; i < 40; ++i) {
    field.rig->command(0.2, 0.0);
    field.bench.run(0.1, [&] {
      if (i > 25) push = std::max(push, field.bench.contact_force("wall", "robot").norm());
    });
  }
  printf("drive against a wall: %.1f N\n", push);
  // Two wheels of 1 N m at 0.035 m; friction with mu 1 under 6.3 kg is less than that.
  EXPECT_LE(push, 6.3 * 9.81 * 1.05);
  EXPECT_GT(push, 1.0);
}

TEST(Drive, RejectsWhatIsNoPairOfSpeeds) {
  Field field;
  EXPECT_FALSE(field.rig->command("").accepted);
  EXPECT_FALSE(field.rig->command("fast").accepted);
  EXPECT_FALSE(field.rig->command("0.1").accepted);
  EXPECT_FALSE(field.rig->command(NAN, 0.0).accepted);
  EXPECT_FALSE(field.rig->command(0.0, INFINITY).accepted);
  EXPECT_TRUE(field.rig->command("0.1 -0.2").accepted);
  EXPECT_TRUE(field.rig->command("Stop").accepted);
}

}  // namespace
}  // namespace angen::test

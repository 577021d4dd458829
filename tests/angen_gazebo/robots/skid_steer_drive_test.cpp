#include <gtest/gtest.h>

#include <cstdio>

#include "robot.h"

namespace angen::robots {
namespace {

std::string wagon(const std::string& more = "") {
  std::string text = "<model name='bot'>" + box("body", 6.0, "0 0 0.1 0 0 0", "0.4 0.2 0.08");
  for (const char* at : {"left_front 0.12 0.15", "left_rear -0.12 0.15", "right_front 0.12 -0.15",
                         "right_rear -0.12 -0.15"}) {
    char name[32];
    double x = 0.0, y = 0.0;
    std::sscanf(at, "%31s %lf %lf", name, &x, &y);
    text += wheel(name, x, y);
  }
  return text +
         plugin("skid_steer_drive",
                "<wheelSeparation>0.3</wheelSeparation>"
                "<wheelDiameter>0.1</wheelDiameter><torque>10</torque>" +
                    more) +
         "</model>";
}

TEST(SkidSteerDrive, GoesStraightWhereItsOdometrySays) {
  Hall hall(wagon());
  hall.run(0.5);
  hall.command("skid_steer_drive", {0.4, 0.0});
  hall.run(3.0);
  EXPECT_NEAR(hall.pose().position.x(), 1.2, 0.05);
  EXPECT_NEAR(hall.pose().position.y(), 0.0, 0.01);
  const Reading odometry = hall.reading("skid_steer_odometry");
  EXPECT_NEAR(list(odometry, "position")[0], hall.pose().position.x(), 0.4 * 0.011);
  EXPECT_NEAR(odometry.get<double>("forward"), 0.4, 0.01);
}

// Its wheels slip sideways, so that it turns slower than wheels without friction across would.
TEST(SkidSteerDrive, TurnsByItsWheelsSlip) {
  Hall hall(wagon());
  hall.run(0.5);
  hall.command("skid_steer_drive", {0.0, 1.0});
  hall.run(2.0);
  const double yaw = to_rpy(hall.pose().rotation).z();
  EXPECT_GT(yaw, 0.4);
  EXPECT_LT(yaw, 2.02);
  const std::vector<double> q = list(hall.reading("skid_steer_odometry"), "orientation");
  EXPECT_NEAR(2.0 * std::atan2(q[2], q[3]), yaw, 0.02);
  EXPECT_NEAR(hall.pose().position.norm(), 0.1, 0.05) << "on the spot";
}

}  // namespace
}  // namespace angen::robots

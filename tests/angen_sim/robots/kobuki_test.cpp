#include <gtest/gtest.h>

#include "robot.h"

namespace angen::robots {
namespace {

std::string base(const std::string& more = "") {
  return robot(
      plugin("kobuki",
             "<left_wheel_joint_name>left_joint</left_wheel_joint_name><right_wheel_joint_name>"
             "right_joint</right_wheel_joint_name><wheel_separation>0.3</wheel_separation>"
             "<wheel_diameter>0.1</wheel_diameter><torque>5</torque><imu_name>imu</imu_name>" +
                 more));
}

double yaw_in(const Reading& odometry) {
  const std::vector<double> q = list(odometry, "orientation");
  return 2.0 * std::atan2(q[2], q[3]);
}

TEST(Kobuki, ItsOdometryFollowsItThroughACurve) {
  Hall hall(base("<velocity_command_timeout>5</velocity_command_timeout>"));
  hall.run(0.5);
  hall.command("kobuki", {0.3, 0.4});
  hall.run(3.0);
  const Reading odometry = hall.reading("kobuki_odometry");
  EXPECT_GT(hall.pose().position.x(), 0.5);
  EXPECT_NEAR(list(odometry, "position")[0], hall.pose().position.x(), 0.02);
  EXPECT_NEAR(list(odometry, "position")[1], hall.pose().position.y(), 0.02);
  EXPECT_NEAR(yaw_in(odometry), to_rpy(hall.pose().rotation).z(), 0.4 * 0.021) << "of its gyro";
  EXPECT_EQ(odometry.get<std::string>("base_frame"), "base_footprint");
}

TEST(Kobuki, StopsAWhileAfterACommand) {
  Hall hall(base());
  hall.run(0.5);
  hall.command("kobuki", {0.2, 0.0});
  hall.run(0.5);
  EXPECT_NEAR(hall.state("bot").get<double>("left"), 0.2, 1e-9);
  hall.run(0.2);
  EXPECT_EQ(hall.state("bot").get<double>("left"), 0.0) << "after 0.6 s";
  hall.run(2.0);
  EXPECT_NEAR(hall.pose().position.x(), 0.12, 0.02);
}

TEST(Kobuki, HasWheelsAndAnImu) {
  Hall hall(base());
  hall.request("kobuki_imu");
  hall.run(1.0);
  EXPECT_NEAR(list(hall.reading("kobuki_imu"), "acceleration")[2], 9.8, 0.02);
  const auto names = hall.reading("kobuki_wheels").get<std::vector<std::string>>("names");
  EXPECT_EQ(names, (std::vector<std::string>{"left_joint", "right_joint"}));
}

}  // namespace
}  // namespace angen::robots

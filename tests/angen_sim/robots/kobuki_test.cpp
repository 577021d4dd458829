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

std::string wall(double x, double yaw) {
  return "<model name='wall'><static>true</static><link name='l'><pose>" + std::to_string(x) +
         " 0 0.5 0 0 " + std::to_string(yaw) +
         "</pose><collision name='c'><geometry><box><size>0.1 4 1</size></box></geometry>"
         "</collision></link></model>";
}

std::string pressed(const Hall& hall) {
  const Reading reading = hall.reading("kobuki_bumper");
  std::string parts;
  for (const char* part : {"left", "center", "right"}) {
    if (reading.get<bool>(part)) parts += std::string(parts.empty() ? "" : " ") + part;
  }
  return parts;
}

TEST(Kobuki, ItsBumperIsPressedWhereAWallIs) {
  for (const auto& [yaw, part] : std::vector<std::pair<double, std::string>>{
           {0.0, "center"}, {0.8, "left"}, {-0.8, "right"}}) {
    Hall hall(base("<velocity_command_timeout>5</velocity_command_timeout>") + wall(0.6, yaw));
    hall.run(0.5);
    EXPECT_EQ(pressed(hall), "") << "on the floor";
    hall.command("kobuki", {0.3, 0.0});
    std::string first;
    for (int i = 0; i < 40 && first.empty(); ++i) {
      hall.run(0.1);
      first = pressed(hall);
    }
    EXPECT_EQ(first, part) << yaw;
    hall.command("kobuki", {-0.3, 0.0});
    hall.run(1.0);
    EXPECT_EQ(pressed(hall), "") << yaw;
  }
}

}  // namespace
}  // namespace angen::robots

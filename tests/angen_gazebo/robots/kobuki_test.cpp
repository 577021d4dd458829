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

TEST(Kobuki, StandsStillWhileItsMotorsAreOff) {
  Hall hall(base("<velocity_command_timeout>60</velocity_command_timeout>"));
  hall.run(0.5);
  hall.command("kobuki", {0.2, 0.0});
  hall.run(1.0);
  hall.command("kobuki", {}, "bot", "MotorsOff");
  hall.run(0.5);
  const double x = hall.pose().position.x();
  EXPECT_NEAR(x, 0.2, 0.02);
  EXPECT_FALSE(hall.state("bot").get<bool>("motors"));
  hall.command("kobuki", {0.2, 0.0});
  hall.run(1.0);
  EXPECT_NEAR(hall.pose().position.x(), x, 1e-3) << "it ignores speeds";
  hall.command("kobuki", {}, "bot", "MotorsOn");
  hall.run(1.0);
  EXPECT_NEAR(hall.pose().position.x(), x, 1e-3) << "also those of before";
  hall.command("kobuki", {0.2, 0.0});
  hall.run(1.0);
  EXPECT_NEAR(hall.pose().position.x(), x + 0.2, 0.02);
}

TEST(Kobuki, ItsOdometryStartsAnewWhereItIsReset) {
  Hall hall(base("<velocity_command_timeout>60</velocity_command_timeout>"));
  hall.run(0.5);
  hall.command("kobuki", {0.3, 0.4});
  hall.run(2.0);
  hall.command("kobuki", {0.0, 0.0});
  hall.run(5.0);  // it sleeps
  EXPECT_GT(list(hall.reading("kobuki_odometry"), "position")[0], 0.3);
  hall.command("kobuki", {}, "bot", "ResetOdometry");
  hall.run(0.05);
  EXPECT_EQ(list(hall.reading("kobuki_odometry"), "position"), (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(list(hall.reading("kobuki_odometry"), "orientation"),
            (std::vector<double>{0, 0, 0, 1}));
  const Pose from = hall.pose();
  hall.command("kobuki", {0.3, -0.4});
  hall.run(2.0);
  const Pose moved = from.inverse() * hall.pose();
  const Reading odometry = hall.reading("kobuki_odometry");
  EXPECT_GT(moved.position.x(), 0.3);
  EXPECT_NEAR(list(odometry, "position")[0], moved.position.x(), 0.02);
  EXPECT_NEAR(list(odometry, "position")[1], moved.position.y(), 0.02);
  EXPECT_NEAR(yaw_in(odometry), to_rpy(moved.rotation).z(), 0.4 * 0.021);
}

TEST(Kobuki, ResetsTheOdometryOfNoOtherRobot) {
  std::string other = base("");
  other.replace(other.find("'bot'"), 5, "'two'");
  other.insert(other.find("<link"), "<pose>0 2 0 0 0 0</pose>");
  Hall hall(base("") + other);
  hall.run(0.5);
  for (const char* name : {"bot", "two"}) hall.command("kobuki", {0.3, 0.0}, name);
  hall.run(1.0);
  hall.command("kobuki", {}, "two", "ResetOdometry");
  hall.run(0.05);
  for (std::size_t i = 0; i < hall.snapshot->structure->sensors.size(); ++i) {
    const sim::SensorEntry& sensor = hall.snapshot->structure->sensors[i];
    if (sensor.kind != "kobuki_odometry") continue;
    const double x = list(*hall.snapshot->reading(i), "position")[0];
    EXPECT_NEAR(x, sensor.name == "bot_p" ? 0.18 : 0.0, 0.03) << sensor.name;
  }
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

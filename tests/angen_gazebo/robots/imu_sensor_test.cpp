#include <gtest/gtest.h>

#include "robot.h"

namespace angen::robots {
namespace {

TEST(ImuSensor, SitsWhereItsPoseSays) {
  const std::string sensor =
      "<sensor name='imu' type='imu'><pose>0 0 0 3.14159265 0 "
      "0</pose><update_rate>200</update_rate>"
      "<plugin name='p' filename='libgazebo_ros_imu_sensor.so'><topicName>imu</topicName>"
      "<initialOrientationAsReference>false</initialOrientationAsReference></plugin></sensor>";
  const std::string text = "<model name='bot'>" +
                           box("body", 2.0, "0 0 0.1 0 0 0.5", "0.2 0.2 0.2", sensor) + "</model>";
  Hall hall(text);
  hall.request("imu_sensor");
  hall.run(1.0);
  const Reading reading = hall.reading("imu_sensor");
  EXPECT_NEAR(list(reading, "acceleration")[2], -9.8, 0.02);  // it hangs upside down
  EXPECT_NEAR(list(reading, "angular_velocity")[2], 0.0, 0.01);
  EXPECT_EQ(reading.stamp % (kSecond / 200), 0);
}

TEST(ImuSensor, HasTheNoiseOfItsPlugin) {
  const std::string sensor =
      "<sensor name='imu' type='imu'><update_rate>1000</update_rate><plugin name='p' "
      "filename='libgazebo_ros_imu_sensor.so'><gaussianNoise>0.2</gaussianNoise></plugin></sensor>";
  Hall hall("<model name='bot'>" + box("body", 2.0, "0 0 0.1 0 0 0", "0.2 0.2 0.2", sensor) +
            "</model>");
  hall.request("imu_sensor");
  hall.run(1.0);
  double squares = 0.0;
  for (int i = 0; i < 2000; ++i) {
    hall.run(0.001);
    squares += std::pow(list(hall.reading("imu_sensor"), "angular_velocity")[0], 2);
  }
  EXPECT_NEAR(std::sqrt(squares / 2000), 0.2, 0.015);
  const std::vector<double> variances = list(hall.reading("imu_sensor"), "variances");
  EXPECT_NEAR(variances[0], 1e-12, 1e-15) << "its orientation has no noise";
  EXPECT_NEAR(variances[3], 0.04, 1e-9);
}

}  // namespace
}  // namespace angen::robots

#include <gtest/gtest.h>

#include "robot.h"

namespace angen::robots {
namespace {

std::string imu(const std::string& more) {
  return robot(
      "<plugin name='i' filename='libhector_gazebo_ros_imu.so'><bodyName>body</bodyName>"
      "<updateRate>1000</updateRate>" +
      more + "</plugin>");
}

TEST(HectorImu, ItsHeadingHasTheErrorOfTheYaw) {
  Hall hall(
      imu("<yawGaussianNoise>0.2</yawGaussianNoise><headingGaussianNoise>9"
          "</headingGaussianNoise>"));
  hall.request("hector_imu");
  double sum = 0.0;
  for (int i = 0; i < 1000; ++i) {
    hall.run(0.001);
    const std::vector<double> q = list(hall.reading("hector_imu"), "orientation");
    sum += std::pow(2.0 * std::atan2(q[2], q[3]), 2);
  }
  EXPECT_NEAR(std::sqrt(sum / 1000.0), 0.2, 0.02);
}

TEST(HectorImu, HasTheErrorsOfItsParameters) {
  Hall hall(
      imu("<accelGaussianNoise>0.1 0.1 0.4</accelGaussianNoise><rateGaussianNoise>0.05"
          "</rateGaussianNoise><accelDrift>0.1 0.1 0.1</accelDrift>"));
  hall.request("hector_imu");
  hall.run(1.0);
  double up = 0.0, turn = 0.0;
  for (int i = 0; i < 2000; ++i) {
    hall.run(0.001);
    const Reading reading = hall.reading("hector_imu");
    up += std::pow(list(reading, "acceleration")[2] - 9.8, 2);
    turn += std::pow(list(reading, "angular_velocity")[0], 2);
  }
  EXPECT_NEAR(std::sqrt(up / 2000), 0.4, 0.03);
  EXPECT_NEAR(std::sqrt(turn / 2000), 0.05, 0.004);
}

TEST(HectorImu, OneNumberOrThreeAreTaken) {
  EXPECT_THROW(Hall{imu("<rateGaussianNoise>1 2</rateGaussianNoise>")}, Error);
  EXPECT_THROW(Hall{imu("<rateGaussianNoise>x</rateGaussianNoise>")}, Error);
}

}  // namespace
}  // namespace angen::robots

#include <gtest/gtest.h>

#include "robot.h"

namespace angen::robots {
namespace {

const std::string kSensor =
    plugin("ft_sensor", "<jointName>left_joint</jointName><topicName>ft</topicName>");

TEST(FtSensor, MeasuresTheLoadThatTheChildIs) {
  const std::string held = "<limit><lower>0</lower><upper>0</upper></limit>";
  Hall hall(arms(kSensor, held));
  hall.request("ft_sensor");
  hall.run(0.3);
  const Reading reading = hall.reading("ft_sensor");
  const std::vector<double> force = list(reading, "force");
  const std::vector<double> torque = list(reading, "torque");
  EXPECT_NEAR(force[0], 0.0, 0.01);
  EXPECT_NEAR(force[2], -9.8, 0.01);
  EXPECT_NEAR(torque[1], 0.2 * 9.8, 0.01);
  EXPECT_NEAR(torque[0], 0.0, 0.01);
  EXPECT_EQ(reading.get<std::string>("frame"), "left");
}

TEST(FtSensor, IsInTheFrameOfTheChild) {
  const std::string tilted = "<limit><lower>1.5707963</lower><upper>1.5707963</upper></limit>";
  Hall hall(arms(kSensor, tilted));
  hall.request("ft_sensor");
  hall.run(1.0);
  const std::vector<double> force = list(hall.reading("ft_sensor"), "force");
  EXPECT_NEAR(force[0], 9.8, 0.05);  // x of the arm points down
  EXPECT_NEAR(force[2], 0.0, 0.05);
}

TEST(FtSensor, AFixedJointIsHeldAndMeasured) {
  const std::string base = plugin("ft_sensor", "<jointName>bot::base</jointName>");
  Hall hall(arms(base, "<limit><lower>0</lower><upper>0</upper></limit>"), true);
  EXPECT_TRUE(hall.warnings.empty());
  hall.request("ft_sensor");
  hall.run(0.3);
  const double mass = 3.0;  // of the body and its two arms
  EXPECT_NEAR(list(hall.reading("ft_sensor"), "force")[2], -9.8 * mass, 0.05);
  EXPECT_NEAR(list(hall.reading("ft_sensor"), "torque")[1], 2.0 * 0.2 * 9.8, 0.05);
  EXPECT_NEAR(hall.pose().position.z(), 1.0, 1e-3);
}

TEST(FtSensor, TwoOfOneNameAreTwo) {
  const Hall hall(arms(plugin("ft_sensor", "<jointName>left_joint</jointName>") +
                       plugin("ft_sensor", "<jointName>right_joint</jointName>")),
                  true);
  EXPECT_TRUE(hall.warnings.empty());
  std::vector<std::string> names;
  for (const auto& sensor : hall.snapshot->structure->sensors) names.push_back(sensor.name);
  EXPECT_EQ(names, (std::vector<std::string>{"bot_p", "bot_p_2"}));
}

}  // namespace
}  // namespace angen::robots

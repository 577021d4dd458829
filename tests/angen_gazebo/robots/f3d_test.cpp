#include <gtest/gtest.h>

#include "robot.h"

namespace angen::robots {
namespace {

TEST(F3d, IsTheSumOfWhatTouchesTheLink) {
  Hall hall("<model name='bot'>" + box("body", 3.0, "0 0 0.1 0 0 0", "0.4 0.4 0.2") +
            plugin("f3d", "<bodyName>body</bodyName><topicName>f</topicName>") +
            "</model><model name='load'>" + box("body", 1.0, "0.1 0 0.25 0 0 0", "0.1 0.1 0.1") +
            "</model>");
  hall.request("f3d");
  hall.run(1.0);
  const Reading reading = hall.reading("f3d");
  // The floor carries both, and the load presses on it: the force that remains holds its own
  // weight.
  EXPECT_NEAR(list(reading, "force")[2], 3.0 * 9.8, 0.1);
  EXPECT_NEAR(list(reading, "torque")[1], 0.0, 0.05);
  EXPECT_EQ(reading.get<std::string>("frame"), "world");
}

}  // namespace
}  // namespace angen::robots

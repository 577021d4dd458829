#include <gtest/gtest.h>

#include "robot.h"

namespace angen::robots {
namespace {

std::string sled(const std::string& more) {
  return "<model name='bot'><link name='body'><pose>0 0 1 0 0 0</pose><inertial><pose>0 0.3 0 0 0 "
         "0</pose><mass>2</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia>"
         "</inertial><gravity>false</gravity></link>" +
         more + "</model>";
}

TEST(Force, PushesItsLinkAtItsCenterUntilToldOtherwise) {
  Hall hall(sled(plugin("force", "<bodyName>body</bodyName><topicName>push</topicName>")));
  hall.command("force", {3.0, 0.0, 1.0, 0.0, 0.0, 0.0}, "bot_body");
  hall.run(2.0);
  // a = F / m, and no turn.
  EXPECT_NEAR(hall.pose().position.x(), 0.5 * 1.5 * 4.0, 0.01);
  EXPECT_NEAR(hall.pose().position.z(), 1.0 + 0.5 * 0.5 * 4.0, 0.005);
  EXPECT_NEAR(to_rpy(hall.pose().rotation).norm(), 0.0, 1e-9);
  hall.command("force", {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, "bot_body");
  hall.run(1.0);
  EXPECT_NEAR(hall.pose().position.x(), 3.0 + 3.0, 0.02);
}

TEST(Force, ATorqueTurnsIt) {
  Hall hall(sled(plugin("force", "<bodyName>bot::body</bodyName><topicName>push</topicName>")));
  hall.command("force", {0.0, 0.0, 0.0, 0.0, 0.0, 0.05}, "bot_body");
  hall.run(2.0);
  EXPECT_NEAR(to_rpy(hall.pose().rotation).z(), 0.5 * 0.5 * 4.0, 0.005);
}

TEST(Force, AModelMayHaveSeveral) {
  Hall hall(robot(plugin("force", "<bodyName>left</bodyName><topicName>l</topicName>", "l") +
                  plugin("force", "<bodyName>right</bodyName><topicName>r</topicName>", "r")));
  std::vector<std::string> names;
  for (const auto& device : hall.snapshot->structure->devices) names.push_back(device.name);
  EXPECT_EQ(names, (std::vector<std::string>{"bot_left", "bot_right"}));
}

}  // namespace
}  // namespace angen::robots

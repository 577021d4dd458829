#include "ros/cost.h"

#include <gtest/gtest.h>

namespace angen::node {
namespace {

Spent spent() {
  auto structure = std::make_shared<sim::Structure>();
  structure->devices.push_back({{"door", "hall0", nullptr, ""}, 0});
  structure->sensors.emplace_back();
  structure->sensors.back().kind = "pir";
  structure->sensors.back().name = "eye";
  Spent all;
  all.ticks.simulated = 4 * kSecond;
  all.ticks.structure = structure;
  all.ticks.each_device = {400'000};
  all.ticks.each_sensor = {8'000'000};
  all.ticks.physics = 20'000'000;
  all.publishing = 1'000'000;
  all.process = 60'000'000;
  all.elapsed = 2 * kSecond;
  return all;
}

TEST(Cost, IsInMicrosecondsForEachSimulatedSecond) {
  const angen_msgs::Cost message = to_message(spent());
  EXPECT_DOUBLE_EQ(message.simulated, 4.0);
  EXPECT_DOUBLE_EQ(message.elapsed, 2.0);
  EXPECT_DOUBLE_EQ(message.process, 15'000.0);
  EXPECT_DOUBLE_EQ(message.physics, 5000.0);
  EXPECT_DOUBLE_EQ(message.publishing, 250.0);
  ASSERT_EQ(message.instances.size(), 2U);
  EXPECT_EQ(message.instances[0].kind, "door");
  EXPECT_EQ(message.instances[0].name, "hall0");
  EXPECT_DOUBLE_EQ(message.instances[0].cost, 100.0);
  EXPECT_EQ(message.instances[1].name, "eye");
  EXPECT_DOUBLE_EQ(message.instances[1].cost, 2000.0);
}

TEST(Cost, IsNothingWhileTimeStandsStill) {
  Spent paused = spent();
  paused.ticks.simulated = 0;
  const angen_msgs::Cost message = to_message(paused);
  EXPECT_EQ(message.process, 0.0);
  EXPECT_EQ(message.instances.at(0).cost, 0.0);
}

}  // namespace
}  // namespace angen::node

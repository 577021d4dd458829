#include "node/cost.h"

#include <gtest/gtest.h>

namespace angen::node {
namespace {

Spent spent() {
  auto structure = std::make_shared<sim::Structure>();
  structure->devices.push_back({{"door", "hall0", nullptr, ""}, 0});
  sim::SensorEntry pir;
  pir.kind = "pir";
  pir.name = "eye";
  structure->sensors.push_back(pir);
  Spent all;
  all.ticks.simulated = 4 * kSecond;
  all.ticks.structure = structure;
  all.ticks.each_device = {400'000};
  all.ticks.each_sensor = {8'000'000};
  all.ticks.physics = 20'000'000;
  all.publishing = 1'000'000;
  all.process = 60'000'000;
  all.main = 48'000'000;
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
  EXPECT_DOUBLE_EQ(message.network, 3000.0);
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

using Due = CostPeriod::Due;
using std::chrono::milliseconds;
constexpr Nanoseconds kMs = 1'000'000;
constexpr CostPeriod::Time kStart{};

/// Ticks of 1 ms from `from` on, at rate 1: when each message is due, in ms.
std::vector<int> due_times(CostPeriod& period, int from, int until) {
  std::vector<int> due;
  for (int i = from; i <= until; ++i) {
    const CostPeriod::Time now = kStart + milliseconds(i);
    const Due what = period.check(i * kMs, false, now);
    if (what != Due::kNo) period.restart(i * kMs, now);
    if (what == Due::kYes) due.push_back(i);
  }
  return due;
}

TEST(CostPeriod, TheFirstSecondIsLeftOut) {
  CostPeriod period;
  period.restart(0, kStart);
  EXPECT_EQ(due_times(period, 0, 4000), (std::vector<int>{2000, 3000, 4000}));
}

TEST(CostPeriod, SpansASecondOfBothTimes) {
  CostPeriod period;
  due_times(period, 0, 2000);  // settled, and published at 2 s
  EXPECT_EQ(period.check(2100 * kMs, false, kStart + milliseconds(3500)), Due::kNo);
  EXPECT_EQ(period.check(3000 * kMs, false, kStart + milliseconds(12000)), Due::kYes);
  period.restart(3000 * kMs, kStart + milliseconds(12000));
  EXPECT_EQ(period.check(9000 * kMs, false, kStart + milliseconds(12900)), Due::kNo);
  EXPECT_EQ(period.check(9900 * kMs, false, kStart + milliseconds(13000)), Due::kYes);
}

TEST(CostPeriod, APauseIsSaidOnceASecond) {
  CostPeriod period;
  due_times(period, 0, 2500);
  EXPECT_EQ(period.check(2500 * kMs, true, kStart + milliseconds(2900)), Due::kNo);
  EXPECT_EQ(period.check(2500 * kMs, true, kStart + milliseconds(3000)), Due::kStill);
}

TEST(CostPeriod, AResetStartsAnew) {
  CostPeriod period;
  due_times(period, 0, 2500);
  EXPECT_EQ(period.check(0, false, kStart + milliseconds(2501)), Due::kDiscard);
}

}  // namespace
}  // namespace angen::node

#include "sim/sensor_scheduler.h"

#include <gtest/gtest.h>

namespace angen::sim {
namespace {

constexpr Nanoseconds kMs = 1'000'000;

Schedule schedule(Nanoseconds start, Nanoseconds sample, Nanoseconds publish) {
  Schedule made;
  made.start = start;
  made.sample = sample;
  made.publish = publish;
  return made;
}

using Sensors = std::vector<std::uint32_t>;

TEST(SensorScheduler, GroupsSensorsWhoseSamplesFallOnTheSameTicks) {
  SensorScheduler scheduler;
  scheduler.assign({schedule(0, 100 * kMs, 100 * kMs), schedule(0, 10 * kMs, 100 * kMs),
                    schedule(300 * kMs, 100 * kMs, 100 * kMs),
                    schedule(350 * kMs, 100 * kMs, 100 * kMs), schedule(0, 100 * kMs, 200 * kMs)},
                   400 * kMs);
  ASSERT_EQ(scheduler.groups().size(), 4U);
  EXPECT_EQ(scheduler.groups()[0].active, (Sensors{0, 2}));
  EXPECT_EQ(scheduler.groups()[1].active, (Sensors{1}));
  EXPECT_EQ(scheduler.groups()[2].active, (Sensors{3}));
  EXPECT_EQ(scheduler.groups()[3].active, (Sensors{4}));
  EXPECT_EQ(scheduler.collect(409 * kMs), Sensors{});
  EXPECT_EQ(scheduler.collect(410 * kMs), Sensors{1});
  EXPECT_EQ(scheduler.collect(411 * kMs), Sensors{});
  EXPECT_EQ(scheduler.collect(450 * kMs), (Sensors{1, 2}));
  EXPECT_EQ(scheduler.collect(500 * kMs), (Sensors{1, 0, 3}));
  EXPECT_TRUE(scheduler.groups()[1].publishes(500 * kMs));
  EXPECT_FALSE(scheduler.groups()[1].publishes(510 * kMs));
  EXPECT_FALSE(scheduler.groups()[3].publishes(500 * kMs));
  scheduler.requeue(1000 * kMs);
  EXPECT_EQ(scheduler.collect(1009 * kMs), Sensors{});
  EXPECT_EQ(scheduler.collect(1010 * kMs), Sensors{1});
}

TEST(SensorScheduler, KeepsApartSensorsThatSampleTogetherButPublishInTurn) {
  SensorScheduler scheduler;
  scheduler.assign({schedule(0, 100 * kMs, 200 * kMs), schedule(100 * kMs, 100 * kMs, 200 * kMs)},
                   400 * kMs);
  ASSERT_EQ(scheduler.groups().size(), 2U);
  EXPECT_EQ(scheduler.collect(500 * kMs), (Sensors{0, 1}));
  EXPECT_FALSE(scheduler.groups()[0].publishes(500 * kMs));
  EXPECT_TRUE(scheduler.groups()[1].publishes(500 * kMs));
}

TEST(SensorScheduler, IdleSensorsAreListedApartUntilTheyAreActivated) {
  SensorScheduler scheduler;
  scheduler.assign(std::vector<Schedule>(5, schedule(0, kMs, kMs)), 0);
  SensorScheduler::Group& group = scheduler.group(0);
  for (const std::uint32_t sensor : {3U, 1U}) scheduler.make_idle(sensor);
  EXPECT_TRUE(scheduler.is_idle(1));
  EXPECT_EQ(group.active.size(), 5U);  // until the update
  scheduler.update_lists(group);
  EXPECT_EQ(group.active, (Sensors{0, 2, 4}));
  EXPECT_EQ(group.idle, (Sensors{1, 3}));
  scheduler.activate(3);
  scheduler.make_idle(0);
  scheduler.update_lists(group);
  EXPECT_EQ(group.active, (Sensors{2, 3, 4}));
  EXPECT_EQ(group.idle, (Sensors{0, 1}));
  EXPECT_FALSE(scheduler.is_idle(3));
}

TEST(SensorScheduler, AStartAtATickIsDueOnce) {
  SensorScheduler scheduler;
  Schedule schedule;
  schedule.start = 5'000'000;
  scheduler.assign({schedule}, 4'000'000);
  EXPECT_EQ(scheduler.collect(5'000'000).size(), 1U);
  EXPECT_TRUE(scheduler.collect(6'000'000).empty());
  EXPECT_EQ(scheduler.collect(5'000'000 + schedule.sample).size(), 1U);
}

}  // namespace
}  // namespace angen::sim

#include "node/tick_times.h"

#include <gtest/gtest.h>

namespace angen::node {
namespace {

TEST(TickTimes, QuantilesAndTheLongestOfWhatWasAdded) {
  TickTimes times;
  for (Nanoseconds i = 1; i <= 1000; ++i) times.add(i * 1000);
  times.add(80'000'000);
  const TickTimes::Summary found = times.take();
  EXPECT_NEAR(static_cast<double>(found.median), 500e3, 0.05 * 500e3);
  EXPECT_NEAR(static_cast<double>(found.p99), 990e3, 0.05 * 990e3);
  EXPECT_EQ(found.longest, 80'000'000);
}

TEST(TickTimes, EachCallIsOfTheTicksSinceTheLastOne) {
  TickTimes times;
  EXPECT_EQ(times.take().longest, 0);
  times.add(5'000);
  EXPECT_EQ(times.take().longest, 5'000);
  EXPECT_EQ(times.take().median, 0);
}

TEST(TickTimes, AQuantileIsNotAboveTheLongest) {
  TickTimes times;
  times.add(1'000'000);
  const TickTimes::Summary found = times.take();
  EXPECT_LE(found.p99, found.longest);
  EXPECT_NEAR(static_cast<double>(found.p99), 1e6, 0.05e6);
}

TEST(TickTimes, HoursFit) {
  TickTimes times;
  times.add(10'000 * kSecond);
  times.add(0);
  EXPECT_EQ(times.take().longest, 10'000 * kSecond);
}

}  // namespace
}  // namespace angen::node

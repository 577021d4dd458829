#include "ros/pacer.h"

#include <gtest/gtest.h>

namespace angen::node {
namespace {

using std::chrono::milliseconds;
constexpr Nanoseconds kMs = 1'000'000;
const Pacer::Clock::time_point kStart{};

TEST(Pacer, WaitsUntilTheWallHasComeSoFar) {
  Pacer pacer(1.0);
  EXPECT_EQ(pacer.ahead(5 * kMs, kStart), milliseconds(0));
  EXPECT_EQ(pacer.ahead(15 * kMs, kStart + milliseconds(4)), milliseconds(6));
}

TEST(Pacer, TwiceTheRateHalvesTheWait) {
  Pacer pacer(2.0);
  pacer.ahead(0, kStart);
  EXPECT_EQ(pacer.ahead(20 * kMs, kStart), milliseconds(10));
}

TEST(Pacer, ARateAtWhichCallsWouldWaitForeverIsNone) {
  for (const double rate : {0.0, 1e-3, 1.0, 1e6}) EXPECT_EQ(rate_problem(rate, kMs), "") << rate;
  for (const double rate : {5e-324, 1e-300, 9e-4}) EXPECT_NE(rate_problem(rate, kMs), "") << rate;
}

TEST(Pacer, RateZeroNeverWaits) {
  Pacer pacer(0.0);
  pacer.ahead(0, kStart);
  EXPECT_EQ(pacer.ahead(1000 * kMs, kStart), milliseconds(0));
}

TEST(Pacer, AShortDelayIsCaughtUp) {
  Pacer pacer(1.0);
  pacer.ahead(0, kStart);
  EXPECT_EQ(pacer.ahead(1 * kMs, kStart + milliseconds(50)), milliseconds(0));
  EXPECT_EQ(pacer.ahead(60 * kMs, kStart + milliseconds(52)), milliseconds(8));
}

TEST(Pacer, ALongDelayIsGivenUp) {
  Pacer pacer(1.0);
  pacer.ahead(0, kStart);
  pacer.ahead(1 * kMs, kStart + milliseconds(5000));
  EXPECT_EQ(pacer.ahead(11 * kMs, kStart + milliseconds(5000)), milliseconds(10));
}

TEST(Pacer, TimeThatJumpsBackStartsAnew) {
  Pacer pacer(1.0);
  pacer.ahead(10'000 * kMs, kStart);
  EXPECT_EQ(pacer.ahead(0, kStart + milliseconds(1)), milliseconds(0));
  EXPECT_EQ(pacer.ahead(10 * kMs, kStart + milliseconds(1)), milliseconds(10));
}

}  // namespace
}  // namespace angen::node

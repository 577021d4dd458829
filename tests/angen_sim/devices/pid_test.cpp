#include "devices/pid.h"

#include <gtest/gtest.h>

namespace angen::devices {
namespace {

constexpr double kPidStep = 0.001;

TEST(Pid, AddsItsThreeShares) {
  Pid pid({2.0, 10.0, 3.0, 100.0, -100.0, 100.0, -100.0});
  EXPECT_NEAR(pid.update(0.5, -0.2, 7.0, kPidStep),
              2.0 * 0.5 + 10.0 * 0.5 * kPidStep - 3.0 * 0.2 + 7.0, 1e-12);
}

TEST(Pid, IntegralIsErrorTimesTimeUpToItsLimit) {
  Pid pid({0.0, 4.0, 0.0, 1.5, -0.5, 100.0, -100.0});
  for (int i = 0; i < 250; ++i) pid.update(1.0, 0.0, 0.0, kPidStep);
  EXPECT_NEAR(pid.integral(), 1.0, 1e-9);
  for (int i = 0; i < 1000; ++i) pid.update(1.0, 0.0, 0.0, kPidStep);
  EXPECT_DOUBLE_EQ(pid.integral(), 1.5);
  for (int i = 0; i < 5000; ++i) pid.update(-1.0, 0.0, 0.0, kPidStep);
  EXPECT_DOUBLE_EQ(pid.integral(), -0.5);
}

TEST(Pid, CommandStaysWithinItsLimits) {
  Pid pid({100.0, 0.0, 0.0, 1.0, -1.0, 12.0, -8.0});
  EXPECT_DOUBLE_EQ(pid.update(1.0, 0.0, 0.0, kPidStep), 12.0);
  EXPECT_DOUBLE_EQ(pid.update(-1.0, 0.0, 0.0, kPidStep), -8.0);
  EXPECT_DOUBLE_EQ(pid.update(0.0, 0.0, 50.0, kPidStep), 12.0);
}

TEST(Pid, DoesNotWindUpWhileCutOff) {
  Pid pid({100.0, 50.0, 0.0, 1000.0, -1000.0, 10.0, -10.0});
  for (int i = 0; i < 5000; ++i) pid.update(1.0, 0.0, 0.0, kPidStep);
  EXPECT_DOUBLE_EQ(pid.integral(), 0.0);
  EXPECT_LT(pid.update(-0.01, 0.0, 0.0, kPidStep), 0.0);
}

TEST(Pid, PlainOneIsTheSumWithinItsLimits) {
  Pid pid({70.0, 200.0, 25.0, 1.5, -0.5, 120.0, -100.0});
  EXPECT_NEAR(pid.update_plain(0.5, -0.2, kPidStep),
              70.0 * 0.5 + 200.0 * 0.5 * kPidStep - 25.0 * 0.2, 1e-12);
  for (int i = 0; i < 1000; ++i) pid.update_plain(0.5, 0.0, kPidStep);
  EXPECT_NEAR(pid.update_plain(0.5, 0.0, kPidStep), 35.0 + 1.5, 1e-12) << "i_max";
  EXPECT_DOUBLE_EQ(pid.update_plain(2.0, 0.0, kPidStep), 120.0);
  EXPECT_DOUBLE_EQ(pid.integral(), 1.5) << "nothing stops the integral but its own limits";
  EXPECT_DOUBLE_EQ(pid.update_plain(-2.0, 0.0, kPidStep), -100.0);
}

TEST(Pid, IntegralMayShrinkWhileCutOff) {
  Pid pid({0.0, 10.0, 0.0, 1000.0, -1000.0, 100.0, -100.0});
  for (int i = 0; i < 1000; ++i) pid.update(1.0, 0.0, 0.0, kPidStep);
  const double before = pid.integral();
  pid.update(-1.0, 0.0, 500.0, kPidStep);
  EXPECT_LT(pid.integral(), before);
}

}  // namespace
}  // namespace angen::devices

#include "sensors/pir/band_pass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace angen::sensors {
namespace {

constexpr double kPeriod = 0.01;  // s

/// Greatest voltage of a sine of 1 W, once it is the same in each period.
double measured_gain(BandPass filter, double frequency) {
  double greatest = 0.0;
  for (int i = 0; i < 10'000; ++i) {
    const double volts = filter.step(std::sin(2.0 * M_PI * frequency * kPeriod * i));
    if (i > 5'000) greatest = std::max(greatest, std::abs(volts));
  }
  return greatest;
}

TEST(BandPass, GainIsWhatASineMeasures) {
  const BandPass filter({}, 3.0, kPeriod);
  EXPECT_NEAR(filter.gain(1.0), 3.0, 1e-9);
  for (const double frequency : {0.1, 0.4, 1.0, 3.0, 10.0}) {
    EXPECT_NEAR(measured_gain(filter, frequency), filter.gain(frequency),
                0.02 * filter.gain(frequency))
        << frequency;
  }
  EXPECT_LT(filter.gain(0.01), 0.05 * filter.gain(1.0));
  EXPECT_LT(filter.gain(30.0), 0.1 * filter.gain(1.0));
}

TEST(BandPass, ConstantFluxGivesNoVoltage) {
  BandPass filter({}, 3.0, kPeriod);
  filter.settle(2.0);
  EXPECT_TRUE(filter.settled(2.0, 1e-12));
  EXPECT_FALSE(filter.settled(2.1, 1e-3));
  for (int i = 0; i < 100; ++i) EXPECT_NEAR(filter.step(2.0), 0.0, 1e-9);
  EXPECT_GT(std::abs(filter.step(2.5)), 1e-3);
  for (int i = 0; i < 10'000; ++i) filter.step(2.5);
  EXPECT_TRUE(filter.settled(2.5, 1e-3));
}

}  // namespace
}  // namespace angen::sensors

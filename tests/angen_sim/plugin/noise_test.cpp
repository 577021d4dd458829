#include "plugin/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace angen {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Rng rng(std::int64_t tick) { return {1, 2, tick}; }

TEST(Noise, OfANumberHasItsMeanAndDeviation) {
  Reading clean;
  clean.set("x", 5.0);
  const Noise noise{"x", 0.5, 0.2, {}, false};
  double sum = 0.0, squares = 0.0;
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    const double x = with_noise({noise}, clean, rng(i)).get<double>("x");
    sum += x;
    squares += (x - 5.5) * (x - 5.5);
  }
  EXPECT_NEAR(sum / kCount, 5.5, 5 * 0.2 / std::sqrt(kCount));
  EXPECT_NEAR(std::sqrt(squares / kCount), 0.2, 0.005);
}

TEST(Noise, OfAListLeavesWhatIsNotFiniteAndKeepsToItsRange) {
  Reading clean;
  clean.set("ranges", std::vector<double>{1.0, kInfinity, 9.9});
  const Noise noise{"ranges", 0.0, 5.0, {0.5, 10.0}, false};
  bool varied = false;
  for (int i = 0; i < 100; ++i) {
    const auto ranges = with_noise({noise}, clean, rng(i)).get<std::vector<double>>("ranges");
    EXPECT_GE(ranges[0], 0.5);
    EXPECT_LE(ranges[2], 10.0);
    EXPECT_EQ(ranges[1], kInfinity);
    varied = varied || ranges[0] != 1.0;
  }
  EXPECT_TRUE(varied);
}

TEST(Noise, RelativeToTheValueKeepsItsSign) {
  Reading clean;
  clean.set("lux", 100.0);
  const Noise noise{"lux", 0.0, 2.0, {}, true};
  for (int i = 0; i < 100; ++i) {
    EXPECT_GE(with_noise({noise}, clean, rng(i)).get<double>("lux"), 0.0);
  }
  clean.set("lux", 0.0);
  EXPECT_EQ(with_noise({noise}, clean, rng(1)).get<double>("lux"), 0.0);
  EXPECT_FALSE(noise.varies(clean));
}

TEST(Noise, VariesOnlyWhereAValueTakesIt) {
  Reading reading;
  const Noise noise{"x", 0.0, 1.0, {}, false};
  EXPECT_FALSE(noise.varies(reading));
  reading.set("x", std::vector<double>{});
  EXPECT_FALSE(noise.varies(reading));
  reading.set("x", std::vector<double>{kInfinity});
  EXPECT_FALSE(noise.varies(reading));
  reading.set("x", std::vector<double>{1.0});
  EXPECT_TRUE(noise.varies(reading));
  EXPECT_FALSE((Noise{"x", 1.0, 0.0, {}, false}).varies(reading));
}

}  // namespace
}  // namespace angen

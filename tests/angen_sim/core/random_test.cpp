#include "core/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace angen {
namespace {

TEST(Rng, DependsOnSeedNameAndTickOnly) {
  const auto first = [](std::uint64_t seed, const char* name, std::int64_t tick) {
    return Rng(seed, hash_bytes(name), tick).next();
  };
  EXPECT_EQ(first(1, "pir", 5), first(1, "pir", 5));
  EXPECT_NE(first(1, "pir", 5), first(2, "pir", 5));
  EXPECT_NE(first(1, "pir", 5), first(1, "pir2", 5));
  EXPECT_NE(first(1, "pir", 5), first(1, "pir", 6));
}

TEST(Rng, GaussianHasMeanZeroAndDeviationOne) {
  constexpr int kCount = 200'000;
  double sum = 0.0;
  double squares = 0.0;
  Rng rng(7, hash_bytes("gaussian"), 0);
  for (int i = 0; i < kCount; ++i) {
    const double x = rng.gaussian();
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 5.0 / std::sqrt(kCount));
  EXPECT_NEAR(squares / kCount, 1.0, 5.0 * std::sqrt(2.0 / kCount));
}

TEST(Rng, GaussiansAreAsManyOfMeanZeroAndDeviationOne) {
  constexpr int kCount = 96, kTicks = 4000;
  double sum = 0.0, squares = 0.0, fourth = 0.0, neighbors = 0.0;
  for (int tick = 0; tick < kTicks; ++tick) {
    double numbers[kCount];
    Rng(7, hash_bytes("scan"), tick).gaussians(numbers, kCount);
    for (int i = 0; i < kCount; ++i) {
      sum += numbers[i];
      squares += std::pow(numbers[i], 2);
      fourth += std::pow(numbers[i], 4);
      if (i > 0) neighbors += numbers[i] * numbers[i - 1];
    }
  }
  const double n = kCount * kTicks;
  EXPECT_NEAR(sum / n, 0.0, 5.0 / std::sqrt(n));
  EXPECT_NEAR(squares / n, 1.0, 5.0 * std::sqrt(2.0 / n));
  EXPECT_NEAR(fourth / n, 3.0, 5.0 * std::sqrt(96.0 / n));
  EXPECT_NEAR(neighbors / n, 0.0, 5.0 / std::sqrt(n));
}

// A scan has no number beyond the limit as often as chance_within() says, and its first uniform()
// shows which.
TEST(Rng, TheFirstDrawTellsHowFarOutGaussiansAre) {
  constexpr int kTicks = 20'000;
  for (const int count : {1, 2, 7, 96}) {
    const double limit = count > 10 ? 2.8 : 1.5;
    const double chance = chance_within(count, limit);
    int within = 0, both = 0;
    for (int tick = 0; tick < kTicks; ++tick) {
      const Rng rng(3, hash_bytes("limit"), tick);
      std::vector<double> numbers(static_cast<std::size_t>(count) + 1);
      Rng(rng).gaussians(numbers.data(), static_cast<std::size_t>(count));
      const bool drawn = Rng(rng).uniform() < chance;
      double farthest = 0.0;
      for (const double x : numbers) farthest = std::max(farthest, std::abs(x));
      within += drawn ? 1 : 0;
      both += drawn && farthest <= limit ? 1 : 0;
      EXPECT_EQ(numbers.back(), 0.0);  // no more than were requested
    }
    EXPECT_EQ(both, within) << count;
    EXPECT_NEAR(within, chance * kTicks, 5.0 * std::sqrt(kTicks * chance * (1.0 - chance)));
  }
}

// One draw at each tick must be as random as many draws at one tick.
TEST(Rng, FirstDrawsOfTicksAreUniform) {
  constexpr int kCount = 100'000;
  double sum = 0.0;
  double products = 0.0;
  double before = 0.0;
  for (int tick = 0; tick < kCount; ++tick) {
    const double x = Rng(7, hash_bytes("pir"), tick).uniform();
    EXPECT_GE(x, 0.0);
    EXPECT_LT(x, 1.0);
    sum += x;
    products += (x - 0.5) * (before - 0.5);
    before = x;
  }
  EXPECT_NEAR(sum / kCount, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / kCount));
  EXPECT_NEAR(products / kCount, 0.0, 5.0 / 12.0 / std::sqrt(kCount));
}

TEST(Hash, IsFnv1a) {
  EXPECT_EQ(hash_bytes(""), 0xcbf29ce484222325ULL);
  EXPECT_EQ(hash_bytes("a"), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(hash_bytes("b", hash_bytes("a")), hash_bytes("ab"));
}

}  // namespace
}  // namespace angen

#include "core/random.h"

#include <gtest/gtest.h>

#include <cmath>

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

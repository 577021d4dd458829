#include "sim/samples_ahead.h"

#include <gtest/gtest.h>

namespace angen::sim {
namespace {

constexpr Nanoseconds kMillisecond = 1'000'000;
constexpr std::uint64_t kSeed = 7, kKey = 11;

struct Samples : ::testing::Test {
  Schedule schedule;
  KnownNoise known;

  Samples() {
    schedule.start = 3 * kMillisecond;
    schedule.sample = 10 * kMillisecond;
  }
  Nanoseconds first_loud(double quiet, Nanoseconds after) {
    return SamplesAhead(0, schedule, after, kSeed, kKey, known).first_loud(quiet);
  }
  /// As first_loud(), of each sample by itself.
  Nanoseconds searched(double quiet, Nanoseconds after) const {
    Nanoseconds at = schedule.next_sample(after);
    while (Rng(kSeed, kKey, at / schedule.step).uniform() < quiet) {
      at = schedule.next_sample(std::max(at, schedule.start + 1));  // the first is at its start
    }
    return at;
  }
};

TEST_F(Samples, TheNextLoudOneIsThatOfASearch) {
  for (const double quiet : {0.5, 0.98}) {
    for (Nanoseconds after = 0; after < 2 * kSecond; after += 37 * kMillisecond) {
      ASSERT_EQ(first_loud(quiet, after), searched(quiet, after)) << quiet << " " << after;
    }
  }
}

TEST_F(Samples, WithoutLoudOnesThereIsNone) { EXPECT_EQ(first_loud(1.0, 0), kForever); }

TEST_F(Samples, NoiseIsKnownTenSecondsAhead) {
  const double rare = 1.0 - 1e-9;
  EXPECT_EQ(first_loud(rare, 0), 10 * kSecond + 3 * kMillisecond);
  EXPECT_EQ(first_loud(rare, 5 * kSecond), 10 * kSecond + 3 * kMillisecond);
  EXPECT_EQ(first_loud(rare, 10 * kSecond + 2 * kMillisecond), 20 * kSecond + 3 * kMillisecond);
}

}  // namespace
}  // namespace angen::sim

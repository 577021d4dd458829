#include "node/lag_warning.h"

#include <gtest/gtest.h>

#include <vector>

namespace angen::node {
namespace {

Nanoseconds cpu_time = 0;
Nanoseconds cpu() { return cpu_time; }

/// Wall seconds at which it spoke, while simulated time passed at that factor.
std::vector<int> spoken(double factor, double rate, int seconds, bool paused = false) {
  LagWarning warning;
  std::vector<int> said;
  const Pacer::Clock::time_point start{std::chrono::hours(1)};
  for (int i = 0; i <= seconds; ++i) {
    const auto time = static_cast<Nanoseconds>(factor * i * kSecond);
    if (!warning.update(time, rate, paused, start + std::chrono::seconds(i), cpu).empty()) {
      said.push_back(i);
    }
  }
  return said;
}

TEST(LagWarning, SpeaksAfterTenSecondsAndThenOnceAMinute) {
  EXPECT_EQ(spoken(0.06, 1.0, 150), (std::vector<int>{10, 70, 130}));
  EXPECT_EQ(spoken(2.0, 10.0, 50), (std::vector<int>{10}));
}

TEST(LagWarning, IsSilentWhereTimeHardlyLagsOrStandsOrHasNoRate) {
  EXPECT_TRUE(spoken(0.6, 1.0, 100).empty());
  EXPECT_TRUE(spoken(0.0, 1.0, 100, true).empty());
  EXPECT_TRUE(spoken(0.01, 0.0, 100).empty());
}

TEST(LagWarning, StartsAnewAfterAReset) {
  LagWarning warning;
  const Pacer::Clock::time_point start{};
  warning.update(100 * kSecond, 1.0, false, start, cpu);
  EXPECT_EQ(warning.update(0, 1.0, false, start + std::chrono::seconds(11), cpu), "");
  const std::string said =
      warning.update(kSecond, 1.0, false, start + std::chrono::seconds(22), cpu);
  EXPECT_NE(said.find("at 0.091 of real time, 1 was requested"), std::string::npos) << said;
}

TEST(LagWarning, NamesWhatTakesTheProcessor) {
  for (const double share : {0.95, 0.3}) {
    LagWarning warning;
    const Pacer::Clock::time_point start{};
    cpu_time = 0;
    warning.update(0, 1.0, false, start, cpu);
    cpu_time = static_cast<Nanoseconds>(share * 20 * kSecond);
    const std::string said =
        warning.update(kSecond, 1.0, false, start + std::chrono::seconds(20), cpu);
    EXPECT_NE(said.find(share > 0.5 ? "`angen top`" : "got 30 % of a processor: other programs"),
              std::string::npos)
        << said;
  }
}

}  // namespace
}  // namespace angen::node

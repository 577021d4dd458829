#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "warm_bench.h"

namespace angen::test {
namespace {

// The voltage's amplitude for a warmth that swings so often a second.
double measured_gain(double frequency) {
  Bench bench(kPir, pyroelectric({kWidePair, {"signal_threshold", "1000"}}));
  const auto id = add_warm(bench, sphere(0.1), at(3, -1), 310.0);
  double flux_high = -1.0, flux_low = 1.0, high = 0.0;
  const int turns = std::max(8, static_cast<int>(20 * frequency));
  const int samples = static_cast<int>(100.0 * turns / frequency);
  for (int i = 0; i < samples; ++i) {
    const double temperature = 310.0 + 0.5 * std::sin(2.0 * M_PI * frequency * i / 100.0);
    bench.scene.warm(id, Warming::constant(temperature));
    ++bench.moves;
    ++bench.world.revisions.temperatures;
    const Reading reading = bench.sample(kSample);
    if (i < samples / 2) continue;
    flux_high = std::max(flux_high, reading.get<double>("flux"));
    flux_low = std::min(flux_low, reading.get<double>("flux"));
    high = std::max(high, std::abs(reading.get<double>("signal")));
  }
  return high / (0.5 * (flux_high - flux_low));
}

double closed_form(double frequency) {
  const std::complex<double> s(0.0, 2.0 * M_PI * frequency);
  const auto low = [&](double tau) { return 1.0 / (1.0 + s * tau); };
  const auto high = [&](double tau) { return s * tau / (1.0 + s * tau); };
  return std::abs(low(0.1) * high(1.6) * high(0.5 / (M_PI * 0.4)) * low(0.5 / (M_PI * 10.0)));
}

TEST(Pyroelectric, PassesTheBandOfItsTimeConstants) {
  EXPECT_NEAR(measured_gain(1.0), 3300.0, 60.0);
  for (const double frequency : {0.05, 0.2, 0.5, 2.0, 5.0}) {
    const double expected = 3300.0 * closed_form(frequency) / closed_form(1.0);
    EXPECT_NEAR(measured_gain(frequency), expected, 0.05 * expected) << frequency;
  }
}

TEST(Pyroelectric, SleepsWithoutShaftsOrNoiseOnceAllIsStill) {
  Bench bench(kPir, pyroelectric({{"noise_stddev", "3e-6"}}));
  const auto id = add_warm(bench, person(), at(4, 0, -1.3), 299.0);
  bench.sample(kSample);
  bench.scene.move(id, at(4, 0.1, -1.3));
  bench.sample(kSample);
  const int queries = bench.world.ray_queries;
  EXPECT_GT(queries, 0);
  EXPECT_NE(bench.sample(kSample).get<double>("signal"), 0.0);
  EXPECT_EQ(bench.world.ray_queries, queries);
  for (int i = 0; i < 3000; ++i) bench.sample(kSample);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(bench.sample(kSample).get<double>("signal", -1.0), 0.0);
}

TEST(Pyroelectric, ComputesWhatItWouldSampleWhileASurfaceWarms) {
  const Element plugin = pyroelectric({kWidePair, {"signal_threshold", "1e-5"}});
  Bench bench(kPir, plugin);
  Bench other(kPir, plugin);  // its surface is set again before each sample
  const Warming course{300.0, 340.0, 5.0, 0};
  const auto id = add_warm(bench, sphere(0.1), at(3, -1), 300.0);
  const auto same = add_warm(other, sphere(0.1), at(3, -1), 300.0);
  bench.scene.warm(id, course);
  std::shared_ptr<const LazyReading> lazy;
  Nanoseconds quiet_until = 0;
  for (Nanoseconds now = 0; now < 100 * kSecond; now += kSample) {
    other.scene.warm(same, Warming::constant(course.at(now)));
    ++other.world.revisions.temperatures;
    const Reading sampled = other.sample(kSample);
    const Reading known = bench.sample(kSample);
    for (const char* field : {"signal", "flux"}) {
      ASSERT_EQ(known.get<double>(field), sampled.get<double>(field)) << field << " at " << now;
      if (!lazy || now % (37 * kSample) != 0) continue;
      Reading computed;
      lazy->read(
          now, [](int) { return Rng(1, 1, 1); }, computed);
      ASSERT_EQ(computed.get<double>(field), known.get<double>(field)) << field << " at " << now;
    }
    ASSERT_TRUE(now >= quiet_until || known.event.empty()) << now;
    if (bench.idle_until() <= now) continue;
    quiet_until = bench.idle_until();
    if (!known.get<bool>("motion") && !lazy) lazy = bench.sensor().lazy_reading();
  }
  EXPECT_NE(lazy, nullptr);
  EXPECT_EQ(quiet_until, INT64_MAX);  // the surface is as warm as it will be
}

TEST(Pyroelectric, NoiseIsThatOfTheSdfAndOfTheSeed) {
  const auto signals = [](std::uint64_t seed) {
    Bench bench(kPir, pyroelectric({kWidePair, {"noise_stddev", "5e-6"}}));
    bench.seed = seed;
    add_warm(bench, sphere(0.02), at(3, 0, 2.9), 310.0);
    std::vector<double> all;
    const auto id = add_warm(bench, sphere(0.001), at(3, -1), 300.0);
    for (int i = 0; i < 4000; ++i) {
      bench.scene.move(id, at(3, -1 + 1e-5 * i));  // nothing to speak of, but it never rests
      all.push_back(bench.sample(kSample).get<double>("signal"));
    }
    return all;
  };
  const std::vector<double> first = signals(1);
  double sum = 0.0;
  for (const double v : first) sum += v * v;
  EXPECT_NEAR(std::sqrt(sum / 4000.0), 5e-6, 0.3e-6);
  EXPECT_EQ(first, signals(1));
  EXPECT_NE(first, signals(2));
}

/// Numbers of samples in a row whose output is off, then on, then off, … with a comparator that
/// fires at every sample while something moves: for `moving` samples of `all`.
std::vector<int> run_lengths(Parameters more, int moving, int all) {
  more.push_back(kWidePair);
  more.emplace_back("noise_stddev", "1e-3");
  more.emplace_back("signal_threshold", "1e-12");
  more.emplace_back("rest_threshold", "1");  // asleep at once when nothing moves
  Bench bench(kPir, pyroelectric(more));
  const auto id = add_warm(bench, sphere(0.1), at(3, -1), 310.0);
  std::vector<int> lengths{0};
  for (int i = 0; i < all; ++i) {
    if (i < moving) bench.scene.move(id, at(3, -1 + 1e-3 * i));
    const bool on = bench.sample(kSample).get<bool>("motion");
    if (on != (lengths.size() % 2 == 0)) lengths.push_back(0);
    ++lengths.back();
  }
  return lengths;
}

// The first sample is never motion: there is none before it.
TEST(Pyroelectric, IsOnForTheHoldTimeAndThenDeafForTheLockoutTime) {
  const std::vector<int> lengths =
      run_lengths({{"hold_time", "0.5"}, {"lockout_time", "1"}, {"retrigger", "false"}}, 400, 400);
  EXPECT_EQ(lengths, (std::vector<int>{1, 50, 100, 50, 100, 50, 49}));
}

TEST(Pyroelectric, FalseAlarmsComeAtTheirRate) {
  Bench bench(
      kPir,
      pyroelectric({{"false_alarm_rate", "3600"}, {"hold_time", "0.01"}, {"lockout_time", "0"}}));
  int alarms = 0;
  for (int i = 0; i < 36'000; ++i) {
    const Reading reading = bench.sample(kSample);
    if (reading.event != "motion") continue;
    ++alarms;
    EXPECT_EQ(reading.event_detail, "false alarm");
  }
  EXPECT_NEAR(alarms, 360, 57);  // three standard deviations
}

/// Whether a person is seen who walks by at `distance` m.
bool seen(double distance, double speed) {
  Bench bench(kPir, pyroelectric({}));
  const double z = 0.875 - kHeight;
  const auto id = add_warm(bench, person(), at(distance, -1.5, z), 299.0);
  const int samples = static_cast<int>(3.0 / speed * 100.0);
  for (int i = 0; i <= samples; ++i) {
    bench.scene.move(id, at(distance, -1.5 + speed * i / 100.0, z));
    if (bench.sample(kSample).get<bool>("motion")) return true;
  }
  return false;
}

TEST(Pyroelectric, MissesWhoMovesTooSlowlyOrTooFastForItsBand) {
  // At 10 m a pair of the lens' first row is 1.5 m wide: 0.013, 0.7 and 70 crossings a second.
  EXPECT_FALSE(seen(10.0, 0.02));
  EXPECT_TRUE(seen(10.0, 1.0));
  EXPECT_FALSE(seen(10.0, 100.0));
}

TEST(Pyroelectric, RejectsWhatMakesNoSense) {
  const auto complaint = [](const char* key, const char* value) {
    return complaint_of(kPir, plugin_element({{"model", "pyroelectric"}, {key, value}}));
  };
  EXPECT_NE(complaint("lens", "round"), "");
  EXPECT_NE(complaint("zone_row", "2 1 -1 0 1"), "");
  EXPECT_NE(complaint("zone_row", "1.5 -1 1 0 1"), "");
  EXPECT_NE(complaint("tape", "0 1 1 0"), "");
  EXPECT_NE(complaint("sample_rate", "10"), "");
  EXPECT_NE(complaint("hold_time", "-1"), "");
  EXPECT_NE(complaint("threshold", "0.1"), "");  // range_difference's
  EXPECT_EQ(complaint("tape", "0 1 0 1"), "");
}

}  // namespace
}  // namespace angen::test

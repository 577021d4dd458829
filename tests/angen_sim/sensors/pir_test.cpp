#include <gtest/gtest.h>

#include <cmath>

#include "bench.h"

namespace angen {
namespace {

using test::at;
using test::Bench;
using test::box;
using test::element;
using test::plugin_element;

const char* const kPir = "libpir_controller.so";

/// A <sensor> with rows x columns rays within ±0.6 and ±0.3 rad, 6 m.
Element fan(int columns, int rows, double noise_stddev = 0.0) {
  const Element scan = element(
      "scan", "",
      {test::scan("horizontal", columns, -0.6, 0.6), test::scan("vertical", rows, -0.3, 0.3)});
  const Element range = element("range", "", {element("min", "0.05"), element("max", "6")});
  return test::sensor_element(
      {element("update_rate", "10"), element("ray", "", {scan, range, test::noise(noise_stddev)})});
}

Element nodding() { return plugin_element({{"nod_amplitude", "0.35"}, {"nod_period", "2"}}); }

TEST(Pir, LooksAlongTheFanOfItsSdf) {
  Bench bench(kPir, plugin_element({}), fan(3, 2));
  bench.world.at = {{1.0, 2.0, 3.0}, from_rpy(0.0, 0.0, M_PI_2)};
  bench.sample();
  ASSERT_EQ(bench.rays_cast.size(), 6U);
  // First the lowest row from right to left; the sensor faces world y, so right is world x.
  const Vec3 lowest_right(std::cos(0.3) * std::sin(0.6), std::cos(0.3) * std::cos(0.6),
                          -std::sin(0.3));
  EXPECT_LT((bench.rays_cast[0].direction - lowest_right).norm(), 1e-6);
  const Vec3 highest_middle(0.0, std::cos(0.3), std::sin(0.3));
  EXPECT_LT((bench.rays_cast[4].direction - highest_middle).norm(), 1e-6);
  EXPECT_EQ(bench.rays_cast[0].origin, Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(bench.rays_cast[0].max, 6.0);
  EXPECT_EQ(bench.rays_cast[0].min, 0.05);
}

TEST(Pir, TheFirstScanIsNoMotion) {
  Bench bench(kPir, plugin_element({}), fan(5, 1));
  bench.add(box(1, 10, 10), at(3.5));
  const Reading reading = bench.sample();
  EXPECT_FALSE(reading.get<bool>("motion", true));
  EXPECT_EQ(reading.get<double>("difference", -1.0), 0.0);
}

TEST(Pir, MotionIsADifferenceAboveTheThreshold) {
  Bench bench(kPir, plugin_element({{"threshold", "0.1"}}), fan(5, 1));
  const auto wall = bench.add(box(1, 10, 10), at(3.5));
  bench.sample();
  bench.scene.move(wall, at(3.57));
  const Reading little = bench.sample();
  EXPECT_FALSE(little.get<bool>("motion", true));
  // The outermost ray is the longest: 0.09 / cos(0.6).
  EXPECT_NEAR(little.get<double>("difference"), 0.07 / std::cos(0.6), 1e-5);
  bench.scene.move(wall, at(3.80));
  const Reading much = bench.sample();
  EXPECT_TRUE(much.get<bool>("motion"));
  EXPECT_NEAR(much.get<double>("difference"), 0.23 / std::cos(0.6), 1e-5);
  EXPECT_EQ(much.get<double>("threshold"), 0.1);
  EXPECT_EQ(much.get<double>("signal"), much.get<double>("difference"));
  EXPECT_EQ(much.get<double>("signal_threshold"), 0.1);
  EXPECT_FALSE(bench.sample().get<bool>("motion", true));
}

TEST(Pir, WhatIsMissedCountsAsTheGreatestRange) {
  Bench bench(kPir, plugin_element({}), fan(1, 1));
  bench.sample();
  bench.add(box(1, 1, 1), at(4.5));
  EXPECT_NEAR(bench.sample().get<double>("difference"), 2.0, 1e-5);
}

TEST(Pir, TellsWhenMotionBeginsAndEnds) {
  Bench bench(kPir, plugin_element({}), fan(1, 1));
  EXPECT_EQ(bench.sample().event, "");
  const auto body = bench.add(box(1, 1, 1), at(4.5));
  EXPECT_EQ(bench.sample().event, "motion");
  bench.scene.move(body, at(4.0));
  EXPECT_EQ(bench.sample().event, "");
  EXPECT_EQ(bench.sample().event, "still");
  EXPECT_EQ(bench.sample().event, "");
}

TEST(Pir, APersonWhoWalksByIsSeenFromAnyDistanceBelowItsRange) {
  for (const double distance : {1.0, 3.0, 5.5}) {
    Bench bench(kPir, plugin_element({}), fan(16, 4, 0.01));
    Shape person;
    person.type = Shape::Type::kCapsule;
    person.radius = 0.25;
    person.length = 1.2;
    const auto id = bench.add(person, at(distance, -2.0));
    bool seen = false;
    for (int i = 0; i < 40; ++i) {
      bench.scene.move(id, at(distance, -2.0 + 0.1 * i));
      seen = bench.sample().get<bool>("motion") || seen;
    }
    EXPECT_TRUE(seen) << distance;
  }
}

TEST(Pir, NoiseMakesNoFalseAlarms) {
  Bench bench(kPir, plugin_element({}), fan(16, 4, 0.01));
  bench.add(box(1, 20, 20), at(4.5));
  int alarms = 0;
  double greatest = 0.0;
  for (int i = 0; i < 20'000; ++i) {
    const Reading reading = bench.sample();
    alarms += reading.get<bool>("motion") ? 1 : 0;
    greatest = std::max(greatest, reading.get<double>("difference"));
  }
  EXPECT_EQ(alarms, 0);
  EXPECT_GT(greatest, 0.05);  // there is noise: of 1.3 million differences some exceed 3.5 sigma
}

/// Scans with a difference above 0.1 m of `scans` of a wall, by noise of `stddev` m alone.
int false_alarms(const Element& plugin, double stddev, int scans) {
  Bench bench(kPir, plugin, fan(16, 3, stddev));
  bench.add(box(1, 40, 40), at(3.5));
  int alarms = 0;
  for (int i = 0; i < scans; ++i) alarms += bench.sample().get<bool>("motion") ? 1 : 0;
  return alarms;
}

TEST(Pir, FalseAlarmsAreAsFrequentAsTheirLawSays) {
  // erfc(threshold / 2 stddev) for each of 48 rays; docs/sensors/pir.md. Five standard deviations:
  // successive scans share one scan's noise, so they count as less than as many.
  for (const auto& [stddev, scans] : {std::pair{0.02, 20'000}, std::pair{0.018, 60'000}}) {
    const double one = std::erfc(0.1 / (2.0 * stddev));
    const double expected = scans * (1.0 - std::pow(1.0 - one, 48));
    ASSERT_GT(expected, 150.0);
    EXPECT_NEAR(false_alarms(plugin_element({}), stddev, scans), expected,
                5.0 * std::sqrt(expected));
  }
  const double expected = 20'000 * (1.0 - std::pow(1.0 - std::erfc(2.5), 48));
  EXPECT_NEAR(false_alarms(nodding(), 0.02, 20'000), expected, 5.0 * std::sqrt(expected));
}

TEST(Pir, NoiseHasTheStandardDeviationOfTheSdf) {
  Bench bench(kPir, plugin_element({{"threshold", "5"}}), fan(1, 1, 0.02));
  bench.add(box(1, 1, 1), at(3.5));
  bench.sample();
  double sum = 0.0;
  const int n = 20'000;
  for (int i = 0; i < n; ++i) {
    const double difference = bench.sample().get<double>("difference");
    sum += difference * difference;
  }
  // Two independent scans differ by 2 sigma^2, known to within 2 % at n = 20000.
  EXPECT_NEAR(std::sqrt(sum / n / 2.0), 0.02, 0.0006);
}

TEST(Pir, AnotherSeedGivesOtherNoiseTheSameTheSame) {
  const auto second_difference = [](std::uint64_t seed) {
    Bench bench(kPir, plugin_element({}), fan(4, 1, 0.01));
    bench.seed = seed;
    bench.add(box(1, 9, 9), at(3.5));
    bench.sample();
    return bench.sample().get<double>("difference");
  };
  EXPECT_EQ(second_difference(7), second_difference(7));
  EXPECT_NE(second_difference(7), second_difference(8));
}

TEST(Pir, NodsAsASine) {
  Bench bench(kPir, nodding(), fan(1, 1));
  for (int k = 0; k < 45; ++k) {
    bench.sample();
    const double pitch = 0.35 * std::sin(2.0 * M_PI * k * 0.1 / 2.0);
    EXPECT_NEAR(bench.rays_cast[0].direction.z(), std::sin(pitch), 1e-9) << k;
  }
}

TEST(Pir, ItsOwnNoddingIsNoMotion) {
  Bench bench(kPir, nodding(), fan(16, 4, 0.01));
  bench.add(box(20, 20, 0.1), at(0, 0, -1.0));  // a floor, whose ranges change as it nods
  bench.add(box(1, 0.5, 0.5), at(3.0));
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(bench.sample().get<bool>("motion", true)) << i;
}

/// The reports of a nodding PIR in a room in which a person comes in, stops, and is deleted.
struct Visit {
  Bench bench{kPir, nodding(), fan(16, 4, 0.01)};
  rays::ShapeId body;
  int motions = 0;
  int departures = 0;

  Visit() {
    bench.add(box(20, 20, 0.1), at(0, 0, -1.0));
    bench.add(box(0.1, 20, 20), at(5.5));
    bench.add(box(0.8, 0.8, 1.2), at(4.0, 1.0, -0.4));  // furniture
    body = bench.add(box(0.4, 0.5, 1.7), at(3.0, 50.0, -0.1));
    stay(40);
  }
  /// The body is at y when the next sample is taken.
  Reading walk_to(double y) {
    bench.scene.move(body, at(3.0, y, -0.1));
    return count();
  }
  void stay(int samples) {
    motions = departures = 0;
    for (int i = 0; i < samples; ++i) count();
  }
  Reading count() {
    Reading reading = bench.sample();
    motions += reading.get<bool>("motion") ? 1 : 0;
    departures += reading.get<bool>("departure") ? 1 : 0;
    EXPECT_FALSE(reading.get<bool>("motion") && reading.get<bool>("departure"));
    return reading;
  }
};

TEST(Pir, ANoddingOneSeesWhatMovesWithinOneSample) {
  Visit visit;
  EXPECT_EQ(visit.motions, 0);
  EXPECT_TRUE(visit.walk_to(0.0).get<bool>("motion"));
  EXPECT_TRUE(visit.walk_to(0.5).get<bool>("motion"));
}

TEST(Pir, WhoStandsIsNoMotionToANoddingOneEitherThoughItHasNotSeenHimAtThisTilt) {
  Visit visit;
  visit.walk_to(0.0);
  visit.stay(60);
  EXPECT_EQ(visit.motions, 0);
  EXPECT_EQ(visit.departures, 0);
}

TEST(Pir, WhatDiffersSinceTheLastNodOnlyBecauseSomebodyHasLeftIsADeparture) {
  Visit visit;
  visit.walk_to(0.0);
  visit.stay(60);
  EXPECT_TRUE(visit.walk_to(50.0).get<bool>("motion"));  // he has just left
  visit.stay(19);
  EXPECT_EQ(visit.motions, 0);
  EXPECT_EQ(visit.departures, 19);  // the rest of a nod of 20
  visit.stay(60);
  EXPECT_EQ(visit.motions + visit.departures, 0);
}

TEST(Pir, ANoddingOneReportsMotionOnlyWhileSomethingMoves) {
  Visit visit;
  int while_moving = 0, while_still = 0;
  for (int round = 0; round < 6; ++round) {
    for (int i = 0; i < 45; ++i) {  // across its view at 1 m/s, a second's stop in the middle
      const bool stops = i >= 20 && i < 30;
      const double y = -1.75 + 0.1 * (i < 20 ? i : stops ? 20 : i - 10);
      const bool motion = visit.walk_to(y).get<bool>("motion");
      // The first sample of a stop still has the last step in it.
      (stops && i > 20 ? while_still : while_moving) += motion ? 1 : 0;
    }
    visit.walk_to(50.0);
    visit.stay(3 + 7 * round);
    while_still += visit.motions;
  }
  EXPECT_GT(while_moving, 6 * 15);
  EXPECT_EQ(while_still, 0);
}

TEST(Pir, OneThatDoesNotNodHasNoDepartures) {
  Bench bench(kPir, plugin_element({}), fan(5, 1));
  const auto body = bench.add(box(1, 1, 1), at(3.5));
  bench.sample();
  bench.scene.move(body, at(3.5, 50.0));
  const Reading reading = bench.sample();
  EXPECT_TRUE(reading.get<bool>("motion"));
  EXPECT_FALSE(reading.get<bool>("departure", true));
}

/// Numbers of samples in a row that are still, then report motion, then are still, … with
/// something that moves before each of the first `moving` samples of `all`.
std::vector<int> run_lengths(const std::vector<std::pair<std::string, std::string>>& parameters,
                             int moving, int all) {
  Bench bench(kPir, plugin_element(parameters), fan(5, 1));
  const auto wall = bench.add(box(1, 10, 10), at(3.5));
  std::vector<int> lengths{0};
  for (int i = 0; i < all; ++i) {
    if (i < moving) bench.scene.move(wall, at(i % 2 == 0 ? 3.5 : 4.0));
    const bool on = bench.sample().get<bool>("motion");
    if (on != (lengths.size() % 2 == 0)) lengths.push_back(0);
    ++lengths.back();
  }
  return lengths;
}

// The first scan is never motion: there is none before it.
TEST(Pir, IsOnForTheHoldTimeAndThenDeafForTheLockoutTime) {
  EXPECT_EQ(run_lengths({}, 20, 40), (std::vector<int>{1, 19, 20}));
  EXPECT_EQ(run_lengths({{"hold_time", "0.5"}}, 20, 40), (std::vector<int>{1, 18 + 5, 16}));
  EXPECT_EQ(
      run_lengths({{"hold_time", "0.5"}, {"lockout_time", "1"}, {"retrigger", "false"}}, 40, 40),
      (std::vector<int>{1, 5, 10, 5, 10, 5, 4}));
  EXPECT_EQ(run_lengths({{"warm_up", "1"}}, 40, 20), (std::vector<int>{10, 10}));
}

TEST(Pir, AClockThatGoesBackStartsAnew) {
  Bench bench(kPir, plugin_element({}), fan(1, 1));
  bench.sample();
  bench.sample();
  bench.add(box(1, 1, 1), at(3.0));
  bench.world.now = 0;
  EXPECT_FALSE(bench.sample().get<bool>("motion", true));
}

TEST(Pir, RejectsANodThatItsScansDoNotDivide) {
  const std::string text = test::complaint_of(
      kPir, plugin_element({{"nod_amplitude", "0.3"}, {"nod_period", "0.25"}}), fan(1, 1));
  EXPECT_EQ(text,
            "test.sdf:1: <nod_period> is 0.25 s, must be a multiple of 0.1 s, the time between "
            "two scans");
  EXPECT_NE(test::complaint_of(kPir, plugin_element({{"nod_amplitude", "0.3"}}), fan(1, 1)), "");
}

TEST(Pir, RejectsWhatMakesNoSense) {
  EXPECT_NE(test::complaint_of(kPir, plugin_element({{"threshold", "0"}})), "");
  EXPECT_NE(test::complaint_of(kPir, plugin_element({{"model", "magic"}})), "");
  EXPECT_NE(test::complaint_of(kPir, plugin_element({}), fan(0, 1)), "");
  EXPECT_NE(test::complaint_of(kPir, plugin_element({}), fan(1, 1, -0.01)), "");
  EXPECT_NE(test::complaint_of(kPir, plugin_element({{"thresold", "1"}})), "");
  EXPECT_NE(test::complaint_of(kPir, plugin_element({{"hold_time", "-1"}})), "");
  EXPECT_EQ(test::complaint_of(kPir, plugin_element({{"blocking_time", "1"}})),
            "test.sdf:1: <blocking_time> is called <lockout_time> now");
  EXPECT_EQ(test::complaint_of(kPir, plugin_element({{"topicName", "/pir"}})), "");
}

}  // namespace
}  // namespace angen

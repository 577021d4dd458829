#include <gtest/gtest.h>

#include <cmath>

#include "bench.h"

namespace angen {
namespace {

using test::Bench;
using test::element;
using test::FakeWorld;
using test::plugin_element;
using Names = std::vector<std::string>;
using Numbers = std::vector<double>;

const char* const kContact = "libgazebo_ros_bumper.so";
const char* const kSeat = "chair::link::seat";
const char* const kBack = "chair::link::back";

Element watching(const Names& collisions) {
  Element contact = element("contact");
  for (const std::string& name : collisions) {
    contact.children.push_back(element("collision", name));
  }
  return test::sensor_element({contact});
}

FakeWorld chair() {
  FakeWorld world;
  world.collisions = {kSeat, kBack};
  return world;
}

ContactPoint point(double x, double force) {
  ContactPoint made;
  made.position = {x, 0.0, 0.5};
  made.depth = 0.001;
  made.force = {0.0, 0.0, force};
  return made;
}

TEST(Contact, ReadsPairsAndPoints) {
  Bench bench(kContact, plugin_element({}), watching({kSeat}), chair());
  bench.world.touching[kSeat] = {{kSeat, "cat::body::box", {point(0.1, -20.0), point(0.2, -22.0)}},
                                 {kSeat, "cup::body::box", {point(0.3, -3.0)}}};
  const Reading reading = bench.sample();
  EXPECT_EQ(reading.get<Names>("collision1"), (Names{kSeat, kSeat}));
  EXPECT_EQ(reading.get<Names>("collision2"), (Names{"cat::body::box", "cup::body::box"}));
  EXPECT_EQ(reading.get<Numbers>("counts"), (Numbers{2, 1}));
  EXPECT_EQ(reading.get<Numbers>("positions"), (Numbers{0.1, 0, 0.5, 0.2, 0, 0.5, 0.3, 0, 0.5}));
  EXPECT_EQ(reading.get<Numbers>("normals"), (Numbers{0, 0, 1, 0, 0, 1, 0, 0, 1}));
  EXPECT_EQ(reading.get<Numbers>("depths"), (Numbers{0.001, 0.001, 0.001}));
  EXPECT_EQ(reading.get<Numbers>("forces"), (Numbers{0, 0, -20, 0, 0, -22, 0, 0, -3}));
  EXPECT_EQ(bench.kind().rate(), 1.0);
}

TEST(Contact, WatchesOnlyTheCollisionsOfItsSdf) {
  Bench bench(kContact, plugin_element({}), watching({kSeat}), chair());
  bench.world.touching[kBack] = {{kBack, "wall::link::box", {point(0.0, 1.0)}}};
  EXPECT_TRUE(bench.sample().get<Names>("collision1").empty());
}

TEST(Contact, TwoWatchedCollisionsThatTouchAreOnePair) {
  Bench bench(kContact, plugin_element({}), watching({kSeat, kBack}), chair());
  bench.world.touching[kSeat] = {{kSeat, kBack, {point(0.0, 1.0)}}};
  bench.world.touching[kBack] = {{kBack, kSeat, {point(0.0, -1.0)}}};
  EXPECT_EQ(bench.sample().get<Names>("collision1"), Names{kSeat});
}

TEST(Contact, TellsWhenItIsPressedAndReleased) {
  Bench bench(kContact, plugin_element({}), watching({kSeat}), chair());
  EXPECT_EQ(bench.sample().event, "");
  bench.world.touching[kSeat] = {{kSeat, "cat::body::box", {point(0.1, -20.0)}}};
  const Reading pressed = bench.sample();
  EXPECT_EQ(pressed.event, "pressed");
  EXPECT_EQ(pressed.event_detail, "by cat::body::box");
  EXPECT_EQ(bench.sample().event, "");
  bench.world.touching.clear();
  EXPECT_EQ(bench.sample().event, "released");
}

TEST(Contact, ADebouncedOneTellsOnlyWhatLasts) {
  constexpr Nanoseconds kSamplePeriod = 10'000'000;
  Bench bench(kContact, plugin_element({{"debounce", "0.05"}}), watching({kSeat}), chair());
  EXPECT_EQ(bench.sensor().sample_period(), kSamplePeriod);
  const auto touch = [&](bool on) {
    bench.world.touching.clear();
    if (on) bench.world.touching[kSeat] = {{kSeat, "cat::body::box", {point(0.1, -20.0)}}};
  };
  bench.sample(kSamplePeriod);
  for (int bounce = 0; bounce < 20; ++bounce) {
    touch(bounce % 5 != 4);  // 40 ms on, 10 ms off
    const Reading reading = bench.sample(kSamplePeriod);
    ASSERT_EQ(reading.event, "");
    ASSERT_FALSE(reading.get<bool>("pressed", true));
    ASSERT_FALSE(reading.urgent);
  }
  touch(true);
  for (int i = 0; i < 5; ++i) ASSERT_EQ(bench.sample(kSamplePeriod).event, "");
  const Reading pressed = bench.sample(kSamplePeriod);
  EXPECT_EQ(pressed.event, "pressed");
  EXPECT_TRUE(pressed.get<bool>("pressed"));
  EXPECT_TRUE(pressed.urgent) << "published at once, not at the next period";
  touch(false);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(bench.sample(kSamplePeriod).get<bool>("pressed"));
  EXPECT_EQ(bench.sample(kSamplePeriod).event, "released");
}

TEST(Contact, WithoutADebounceItSamplesOnlyWhenItPublishes) {
  const Bench bench(kContact, plugin_element({{"sample_rate", "500"}}), watching({kSeat}), chair());
  EXPECT_EQ(bench.sensor().sample_period(), 0);
}

TEST(Contact, NoiseIsOnForcesOnly) {
  Bench bench(kContact, plugin_element({{"noise_stddev", "0.5"}}), watching({kSeat}), chair());
  bench.world.touching[kSeat] = {{kSeat, "cat::body::box", {point(0.1, -20.0)}}};
  double squares = 0.0;
  const int n = 10'000;
  for (int i = 0; i < n; ++i) {
    const Reading reading = bench.sample();
    ASSERT_EQ(reading.get<Numbers>("positions"), (Numbers{0.1, 0, 0.5}));
    ASSERT_EQ(reading.get<Numbers>("depths"), Numbers{0.001});
    const Numbers force = reading.get<Numbers>("forces");
    squares += std::pow(force[0], 2) + std::pow(force[1], 2) + std::pow(force[2] + 20.0, 2);
  }
  EXPECT_NEAR(std::sqrt(squares / n / 3.0), 0.5, 0.015);
}

TEST(Contact, RejectsNoCollisionAndUnknownOnesAtTheirPlace) {
  EXPECT_NE(test::complaint_of(kContact, plugin_element({})).find("watches nothing"),
            std::string::npos);
  Element sensor = watching({"chair::link::leg"});
  sensor.children[0].children[0].source = {"a.world", 40};
  EXPECT_EQ(test::complaint_of(kContact, plugin_element({}), sensor, chair()),
            "a.world:40: no collision chair::link::leg; known are chair::link::seat, "
            "chair::link::back");
}

TEST(Contact, NamesWhatTouchedSinceItsLastReading) {
  Bench bench(kContact, plugin_element({}), watching({kSeat}), chair());
  bench.world.touched[kSeat] = {{kSeat, "cat::body::box", {point(0.1, -20.0)}}};
  const Reading reading = bench.sample();
  EXPECT_EQ(reading.get<Names>("collision2"), Names{"cat::body::box"});
  EXPECT_EQ(bench.idle_until(), 0) << "the next reading is another";
  bench.world.touched.clear();
  EXPECT_TRUE(bench.sample().get<Names>("collision2").empty());
  EXPECT_EQ(bench.idle_until(), kForever);
}

TEST(Contact, PointsAreInTheFrameOfALinkThatItNames) {
  FakeWorld world = chair();
  world.links = {{"base", {}}};
  world.links[0].second.state.pose = {{1.0, 0.0, 0.0}, from_rpy(0.0, 0.0, M_PI_2)};
  world.touching[kSeat] = {{kSeat, "cat::body::box", {point(0.1, -20.0)}}};
  Bench bench(kContact, plugin_element({{"frameName", "base"}}), watching({kSeat}), world);
  Reading reading = bench.sample();
  const Numbers at = reading.get<Numbers>("positions");
  EXPECT_NEAR(at[0], 0.0, 1e-12);
  EXPECT_NEAR(at[1], 0.9, 1e-12);
  EXPECT_NEAR(at[2], 0.5, 1e-12);
  EXPECT_EQ(reading.get<std::string>("frame"), "base");
  Bench other(kContact, plugin_element({{"frameName", "map"}}), watching({kSeat}), world);
  reading = other.sample();
  EXPECT_EQ(reading.get<Numbers>("positions")[0], 0.1);
  EXPECT_EQ(reading.get<std::string>("frame"), "world");
}

}  // namespace
}  // namespace angen

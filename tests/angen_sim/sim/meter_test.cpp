// The meter's figures, and that a world does not know of it.
#include <time.h>

#include "angen_sim/sim/room.h"
#include "record/fingerprint.h"

namespace angen::sim {
namespace {

constexpr Nanoseconds kWork = 200'000;

Nanoseconds thread_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return now.tv_sec * kSecond + now.tv_nsec;
}

/// Costs kWork a reading.
class Heavy : public Sensor {
 public:
  void configure(Params&, Wiring&) override {}
  void read(const View&, Hits, Rng&, Reading&) override {
    const Nanoseconds end = thread_time() + kWork;
    while (thread_time() < end) {
    }
  }
};

class HeavyPlugin : public Plugin {
 public:
  const Kind& kind() const override {
    static const Kind kind("heavy", "");
    return kind;
  }
  std::unique_ptr<Sensor> make_sensor(Params&) const override { return std::make_unique<Heavy>(); }
};

std::unique_ptr<Simulation> simulation(const std::string& text) {
  auto catalog = std::make_shared<Catalog>();
  catalog->add("libheavy.so", std::make_shared<HeavyPlugin>());
  return simulation_of(text, 5, catalog);
}

std::string one_model(const std::string& sensors) {
  return in_world(body("it", "<box><size>0.1 0.1 0.1</size></box>", "0 0 1 0 0 0", true, sensors));
}

const std::string kHeavy =
    "<sensor name='heavy' type='ray'><update_rate>10</update_rate><plugin name='p' "
    "filename='libheavy.so'/></sensor>";

void run(Simulation& simulation, double seconds) {
  const Nanoseconds end = simulation.snapshot()->time + from_seconds(seconds);
  while (simulation.snapshot()->time < end) simulation.tick();
}

TEST(Metering, AMeasuredWorldIsBitForBitTheSame) {
  const auto plain = simulation(room());
  const auto measured = simulation(room());
  record::Fingerprint of_plain;
  record::Fingerprint of_measured;
  for (int i = 0; i < 4000; ++i) {
    if (i % 1000 == 0) measured->measure(i % 2000 == 0);
    if (i % 300 == 0) measured->take_cost();
    of_plain.add(*plain->tick());
    of_measured.add(*measured->tick());
  }
  EXPECT_EQ(of_plain.value(), of_measured.value());
}

TEST(Metering, AMeasuredLeapEndsAtTheSameTicks) {
  const std::string text =
      one_model(ray_sensor("clean", kPir, 10, 0.0) + ray_sensor("noisy", kPir, 10, 0.01));
  const auto plain = simulation(text);
  const auto measured = simulation(text);
  measured->measure(true);
  record::Fingerprint of_plain;
  record::Fingerprint of_measured;
  while (plain->snapshot()->time < 100 * kSecond) {
    of_plain.add(*plain->leap(100 * kSecond));
    of_measured.add(*measured->leap(100 * kSecond));
  }
  EXPECT_EQ(of_plain.value(), of_measured.value());
  EXPECT_EQ(measured->take_cost().simulated, 100 * kSecond);
}

TEST(Metering, ASensorIsChargedForItsReadings) {
  const auto world = simulation(one_model(kHeavy + ray_sensor("clean", kPir, 10, 0.0)));
  world->measure(true);
  run(*world, 2.0);
  const Cost cost = world->take_cost();
  EXPECT_EQ(cost.simulated, 2 * kSecond);
  ASSERT_EQ(cost.each_sensor.size(), 2U);
  EXPECT_EQ(cost.structure->sensors[0].kind, "heavy");
  EXPECT_GE(cost.each_sensor[0], 19 * kWork);  // a short absence before may be taken off
  EXPECT_GT(cost.each_sensor[1], 0);
  EXPECT_GE(cost.sensors, cost.each_sensor[0] + cost.each_sensor[1]);
  EXPECT_GT(cost.physics, 0);
}

TEST(Metering, ABatchIsPaidForByTheRay) {
  // On a link that moves all rays are cast, in one batch.
  const auto world = simulation(
      "<sdf version='1.6'><world name='w'><gravity>0 0 -9.8</gravity>" +
      body("floor", "<box><size>9 9 0.2</size></box>", "0 0 -0.1 0 0 0", true) +
      body("it", "<sphere><radius>0.1</radius></sphere>", "0 0 4 0 0 0", false,
           ray_sensor("few", "liboptical_switch_controller.so", 100, 0.0) +
               "<sensor name='many' type='ray'><update_rate>100</update_rate><ray><scan>"
               "<horizontal><samples>1000</samples><min_angle>-3</min_angle><max_angle>3"
               "</max_angle></horizontal></scan><range><min>0.02</min><max>5</max></range></ray>"
               "<plugin name='p' filename='libpir_controller.so'/></sensor>") +
      "</world></sdf>");
  world->measure(true);
  run(*world, 0.5);
  const Cost cost = world->take_cost();
  EXPECT_GT(cost.each_sensor[1], cost.each_sensor[0]);
}

TEST(Metering, WhatCameIsChargedAndWhatIsGoneIsLeftOut) {
  const auto world = simulation(one_model(kHeavy));
  world->measure(true);
  world->post(Spawn{load::model(body("new", "<box><size>0.1 0.1 0.1</size></box>", "0 0 3 0 0 0",
                                     true, ray_sensor("eye", kPir, 10, 0.0)),
                                "new", {}, {})});
  run(*world, 0.5);
  Cost cost = world->take_cost();
  ASSERT_EQ(cost.each_sensor.size(), 2U);
  EXPECT_GT(cost.each_sensor[1], 0);
  EXPECT_GT(cost.commands, 0);
  world->post(Delete{"it"});
  run(*world, 0.5);
  cost = world->take_cost();
  ASSERT_EQ(cost.each_sensor.size(), 1U);
  EXPECT_LT(cost.each_sensor[0], 5 * kWork);
}

TEST(Metering, NothingIsMeasuredUnlessItIsOn) {
  const auto world = simulation(one_model(kHeavy));
  run(*world, 0.5);
  const Cost cost = world->take_cost();
  EXPECT_EQ(cost.simulated, 0);
  EXPECT_EQ(cost.each_sensor, std::vector<Nanoseconds>{0});
  EXPECT_EQ(cost.physics + cost.sensors + cost.devices + cost.commands + cost.snapshots, 0);
}

}  // namespace
}  // namespace angen::sim

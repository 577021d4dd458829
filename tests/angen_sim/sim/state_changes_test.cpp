#include "sim/state_changes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "angen_sim/sim/household.h"
#include "plugin/view.h"

namespace angen::sim {
namespace {

Reading state(const char* field, double value) {
  Reading made;
  made.set("name", "it");
  made.set(field, value);
  return made;
}

constexpr Heights kAnywhere{-HUGE_VAL, HUGE_VAL};

constexpr Heights height(double z) { return {z, z}; }

TEST(StateChanges, OnlyDevicesWithTheFieldCount) {
  StateChanges changes;
  StateChanges::Device device;
  const auto gap = changes.bit_of("gap");
  const auto heat = changes.bit_of("heat");
  changes.note(state("gap", 0.2), height(0.0), device, 7);
  EXPECT_TRUE(changes.changed_since(gap, kAnywhere, 7));
  EXPECT_FALSE(changes.changed_since(gap, kAnywhere, 8));
  EXPECT_FALSE(changes.changed_since(heat, kAnywhere, 7));
  EXPECT_FALSE(changes.changed_since(0, kAnywhere, 7));
  EXPECT_TRUE(changes.changed_since(heat | gap, kAnywhere, 7));
}

TEST(StateChanges, ThatADeviceComesOrGoesCountsForEachField) {
  StateChanges changes;
  const auto gap = changes.bit_of("gap");
  changes.note_all(3);
  EXPECT_TRUE(changes.changed_since(gap, kAnywhere, 3));
  EXPECT_FALSE(changes.changed_since(gap, kAnywhere, 4));
  EXPECT_TRUE(changes.changed_since(changes.bit_of("new"), kAnywhere, 3));
}

TEST(StateChanges, FieldsAfterManyOthersChangeWithAnyDevice) {
  StateChanges changes;
  for (int i = 0; i < 100; ++i) changes.bit_of("field" + std::to_string(i));
  const auto late = changes.bit_of("late");
  StateChanges::Device device;
  changes.note(state("another", 0.1), height(0.0), device, 4);
  EXPECT_TRUE(changes.changed_since(late, kAnywhere, 4));
  EXPECT_FALSE(changes.changed_since(changes.bit_of("field3"), kAnywhere, 4));
}

TEST(StateChanges, ADeviceCountsAtItsHeightAndAtThatWhichItLeaves) {
  StateChanges changes;
  StateChanges::Device lift;
  const auto gap = changes.bit_of("gap");
  const auto changed = [&](double low, double high, StateChanges::Moment since) {
    return changes.changed_since(gap, {low, high}, since);
  };
  changes.note(state("gap", 0.1), height(1.0), lift, 3);
  EXPECT_TRUE(changed(0.0, 3.0, 3));
  EXPECT_FALSE(changed(8.0, 11.0, 3));
  EXPECT_FALSE(changes.changed_since(gap, {}, 3)) << "a query of nothing";
  changes.note(state("gap", 0.1), height(9.0), lift, 5);
  EXPECT_TRUE(changed(8.0, 11.0, 5));
  EXPECT_TRUE(changed(0.0, 3.0, 5)) << "it has left";
  EXPECT_FALSE(changed(-9.0, -6.0, 5));
  changes.note(state("gap", 0.2), height(9.0), lift, 6);
  EXPECT_FALSE(changed(0.0, 3.0, 6));
  EXPECT_TRUE(changes.changed_since(gap, kAnywhere, 6));
  EXPECT_TRUE(changed(-1e6, 1e6, 6));
}

TEST(StateChanges, ADeviceInManyLayersCountsInAll) {
  StateChanges changes;
  StateChanges::Device tall;
  const auto gap = changes.bit_of("gap");
  changes.note(state("gap", 0.1), {1.0, 9.0}, tall, 3);
  EXPECT_TRUE(changes.changed_since(gap, {5.0, 7.0}, 3));
  EXPECT_FALSE(changes.changed_since(gap, {13.0, 15.0}, 3));
  changes.note(state("gap", 0.1), {1.0, 1e7}, tall, 4);
  EXPECT_TRUE(changes.changed_since(gap, {1e6, 1e6 + 1.0}, 4));
  EXPECT_FALSE(changes.changed_since(gap, {}, 4));
}

TEST(StateChanges, AFieldThatIsQueriedLaterIsNotedFromThenOn) {
  StateChanges changes;
  StateChanges::Device device;
  changes.note(state("gap", 0.1), height(1.0), device, 3);
  const auto gap = changes.bit_of("gap");
  changes.note(state("gap", 0.2), height(1.0), device, 4);
  EXPECT_TRUE(changes.changed_since(gap, {0.0, 3.0}, 4));
}

/// Queries devices by a field, and counts how often.
class Counting : public Sensor {
 public:
  explicit Counting(std::string field) : field_(std::move(field)) {}
  void configure(Params&, Wiring&) override {}
  void read(const View& view, Hits, Rng&, Reading& reading) override {
    reading.set("devices", static_cast<std::int64_t>(view.devices(field_).size()));
    reading.set("samples", ++samples_);
  }
  Nanoseconds idle_until(const Ahead&) const override { return kForever; }

 private:
  std::string field_;
  std::int64_t samples_ = 0;
};

class CountingPlugin : public Plugin {
 public:
  explicit CountingPlugin(const char* field) : field_(field), kind_(field, "Counts samples.") {}
  const Kind& kind() const override { return kind_; }
  std::unique_ptr<Sensor> make_sensor(Params&) const override {
    return std::make_unique<Counting>(field_);
  }

 private:
  std::string field_;
  Kind kind_;
};

TEST(StateChanges, ASensorSamplesAgainForDevicesThatItQueried) {
  const auto catalog = std::make_shared<Catalog>();
  std::string sensors;
  for (const char* field : {"power", "temperatures"}) {
    catalog->add(std::string("lib") + field + ".so", std::make_shared<CountingPlugin>(field));
    sensors += custom(field, field, "");
  }
  // Warmed by a heater, the climate reports another temperature each second, and the heater
  // nothing.
  const std::string text =
      "<sdf version='1.6'><world name='w'><model name='flat'><static>true</static><link name='l'/>"
      "<angen:room name='r'><angen:polygon>-3 -3 3 -3 3 2 -3 2</angen:polygon></angen:room>"
      "<plugin name='c' filename='libroom_climate.so'/></model>"
      "<model name='stove'><static>true</static><link name='l'/><plugin name='h' "
      "filename='libheater.so'/></model>" +
      body("it", "<box><size>0.05 0.05 0.05</size></box>", "0 0 1 0 0 0", true, sensors) +
      "</world></sdf>";
  Simulation simulation(load::world_from_text(text, "test", {}), 1, catalog);
  simulation.post(ToDevice{"heater", "stove", {"On", {}}});
  for (int i = 0; i < 30'000; ++i) simulation.tick();
  const auto samples = [&](std::size_t sensor) {
    return simulation.snapshot()->reading(sensor)->get<std::int64_t>("samples");
  };
  EXPECT_LE(samples(0), 3);
  EXPECT_GE(samples(1), 25);
}

TEST(StateChanges, ADeviceThatIsPutElsewhereIsFoundThere) {
  const std::string text =
      "<sdf version='1.6'><world name='w'><model name='phone'><static>true</static><pose>1 0 1 0 0 "
      "0</pose><link name='l'/><plugin name='r' filename='libradio_transmitter.so'/></model>" +
      body("it", "<box><size>0.05 0.05 0.05</size></box>", "0 0 1 0 0 0", true,
           custom("radio", "radio_receiver", "")) +
      "</world></sdf>";
  Simulation simulation(load::world_from_text(text, "test", {}), 1, std::make_shared<Catalog>());
  const auto strength = [&] {
    return simulation.snapshot()->reading(0)->get<std::vector<double>>("rssi").at(0);
  };
  for (int i = 0; i < 3000; ++i) simulation.tick();
  const double at_1 = strength();
  SetModelState away;
  away.model = "phone";
  away.state.pose = Pose{{2.0, 0.0, 1.0}, Quat::Identity()};
  simulation.post(away);
  for (int i = 0; i < 1100; ++i) simulation.tick();
  EXPECT_NEAR(strength(), at_1 - 20.0 * std::log10(2.0), 0.01);  // free space
}

}  // namespace
}  // namespace angen::sim

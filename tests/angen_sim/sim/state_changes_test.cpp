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

TEST(StateChanges, OnlyDevicesWithTheFieldCount) {
  StateChanges changes;
  const auto gap = changes.bit_of("gap");
  const auto heat = changes.bit_of("heat");
  changes.note(state("gap", 0.2), 7);
  EXPECT_TRUE(changes.changed_since(gap, 7));
  EXPECT_FALSE(changes.changed_since(gap, 8));
  EXPECT_FALSE(changes.changed_since(heat, 7));
  EXPECT_FALSE(changes.changed_since(0, 7));
  EXPECT_TRUE(changes.changed_since(heat | gap, 7));
}

TEST(StateChanges, ThatADeviceComesOrGoesCountsForEachField) {
  StateChanges changes;
  const auto gap = changes.bit_of("gap");
  changes.note_all(3);
  EXPECT_TRUE(changes.changed_since(gap, 3));
  EXPECT_FALSE(changes.changed_since(gap, 4));
  EXPECT_TRUE(changes.changed_since(changes.bit_of("new"), 3));
}

TEST(StateChanges, FieldsAfterManyOthersChangeWithAnyDevice) {
  StateChanges changes;
  for (int i = 0; i < 100; ++i) changes.bit_of("field" + std::to_string(i));
  const auto late = changes.bit_of("late");
  changes.note(state("another", 0.1), 4);
  EXPECT_TRUE(changes.changed_since(late, 4));
  EXPECT_FALSE(changes.changed_since(changes.bit_of("field3"), 4));
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

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
  EXPECT_TRUE(changes.changed_since(gap, {}, 3));
  EXPECT_FALSE(changes.changed_since(gap, {}, 4));
  EXPECT_TRUE(changes.changed_since(changes.bit_of("new"), {}, 3));
}

TEST(StateChanges, FieldsAfterManyOthersChangeWithAnyDevice) {
  StateChanges changes;
  StateChanges::Device device;
  for (int i = 0; i < 100; ++i) changes.bit_of("field" + std::to_string(i));
  const auto late = changes.bit_of("late");
  changes.note(state("another", 0.1), height(0.0), device, 4);
  EXPECT_TRUE(changes.changed_since(late, kAnywhere, 4));
  EXPECT_FALSE(changes.changed_since(changes.bit_of("field3"), kAnywhere, 4));
}

TEST(StateChanges, ADeviceCountsAtItsHeightAndAtThatWhichItLeaves) {
  StateChanges changes;
  StateChanges::Device device;
  const auto gap = changes.bit_of("gap");
  const auto changed = [&](double low, double high, StateChanges::Moment since) {
    return changes.changed_since(gap, {low, high}, since);
  };
  EXPECT_TRUE(changes.note(state("gap", 0.1), height(1.0), device, 3));
  EXPECT_TRUE(changed(0.0, 3.0, 3));
  EXPECT_FALSE(changed(8.0, 11.0, 3));
  EXPECT_FALSE(changes.changed_since(gap, {}, 3)) << "a query of nothing";
  EXPECT_TRUE(changes.note(state("gap", 0.1), height(9.0), device, 5));
  EXPECT_TRUE(changed(8.0, 11.0, 5));
  EXPECT_TRUE(changed(0.0, 3.0, 5)) << "it has left";
  EXPECT_FALSE(changed(-9.0, -6.0, 5));
  EXPECT_FALSE(changes.note(state("gap", 0.2), height(9.1), device, 6));
  EXPECT_FALSE(changed(0.0, 3.0, 6));
  EXPECT_TRUE(changes.changed_since(gap, kAnywhere, 6));
  EXPECT_TRUE(changed(-1e300, 1e300, 6));
}

TEST(StateChanges, ADeviceAtManyHeightsCountsAtAll) {
  StateChanges changes;
  StateChanges::Device device;
  const auto gap = changes.bit_of("gap");
  changes.note(state("gap", 0.1), {1.0, 9.0}, device, 3);
  EXPECT_TRUE(changes.changed_since(gap, {5.0, 7.0}, 3));
  EXPECT_FALSE(changes.changed_since(gap, {13.0, 15.0}, 3));
  changes.note(state("gap", 0.1), {1.0, 1e7}, device, 4);
  EXPECT_TRUE(changes.changed_since(gap, {1e6, 1e6 + 1.0}, 4));
  EXPECT_FALSE(changes.changed_since(gap, {}, 4));
}

/// Queries devices by a field at some heights, and counts how often.
class Counting : public Sensor {
 public:
  Counting(std::string field, const Heights& at) : field_(std::move(field)), at_(at) {}
  void configure(Params&, Wiring&) override {}
  void read(const View& view, Hits, Rng&, Reading& reading) override {
    const Vec3 far(HUGE_VAL, HUGE_VAL, 0.0);
    const auto found = view.devices(
        field_, {Vec3(-far + at_.low * Vec3::UnitZ()), Vec3(far + at_.high * Vec3::UnitZ())});
    reading.set("devices", static_cast<std::int64_t>(found.size()));
    reading.set("samples", ++samples_);
  }
  Nanoseconds idle_until(const Ahead&) const override { return kForever; }

 private:
  std::string field_;
  Heights at_;
  std::int64_t samples_ = 0;
};

class CountingPlugin : public Plugin {
 public:
  CountingPlugin(const std::string& name, std::string field, const Heights& at)
      : field_(std::move(field)), at_(at), kind_(name, "Counts samples.") {}
  const Kind& kind() const override { return kind_; }
  std::unique_ptr<Sensor> make_sensor(Params&) const override {
    return std::make_unique<Counting>(field_, at_);
  }

 private:
  std::string field_;
  Heights at_;
  Kind kind_;
};

TEST(StateChanges, ASensorSamplesAgainForDevicesThatItQueried) {
  const auto catalog = std::make_shared<Catalog>();
  std::string sensors;
  const auto add = [&](const std::string& name, const char* field, const Heights& at) {
    catalog->add("lib" + name + ".so", std::make_shared<CountingPlugin>(name, field, at));
    sensors += custom(name, name, "");
  };
  add("powers", "power", kAnywhere);
  add("climates", "temperatures", kAnywhere);
  add("above", "temperatures", {4.0, 7.0});
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
  EXPECT_LE(samples(2), 3) << "the climate is on the floor below";
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

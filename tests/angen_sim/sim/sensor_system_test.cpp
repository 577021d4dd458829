#include "sim/sensor_system.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "angen_sim/sim/household.h"
#include "plugin/view.h"
#include "plugin/wiring.h"

namespace angen::sim {
namespace {

/// Queries a link of its own model, and counts how often.
class CountingLink : public Sensor {
 public:
  void configure(Params&, Wiring& wiring) override { link_ = wiring.link("link"); }
  Nanoseconds sample_period() const override { return kSecond / 100; }
  void read(const View& view, Hits, Rng&, Reading& reading) override {
    reading.set("height", view.link(link_).pose.position.z());
    reading.set("samples", ++samples_);
  }
  Nanoseconds idle_until(const Ahead&) const override { return kForever; }

 private:
  LinkRef link_;
  std::int64_t samples_ = 0;
};

class CountingLinkPlugin : public Plugin {
 public:
  const Kind& kind() const override { return kind_; }
  std::unique_ptr<Sensor> make_sensor(Params&) const override {
    return std::make_unique<CountingLink>();
  }

 private:
  Kind kind_{"counting", "Counts samples."};
};

TEST(SensorSystem, WhatQueriesItsOwnModelSamplesWhileThatMoves) {
  const auto catalog = std::make_shared<Catalog>();
  catalog->add("libcounting.so", std::make_shared<CountingLinkPlugin>());
  // One falls and comes to rest; the other's ball rolls away for ever.
  const std::string text =
      "<sdf version='1.6'><world name='w'><model name='floor'><static>true</static><link "
      "name='l'><collision name='c'><geometry><plane/></geometry></collision></link></model>" +
      body("crate", "<box><size>0.2 0.2 0.2</size></box>", "0 0 1.1 0 0 0", false,
           custom("a", "counting", "")) +
      body("ball", "<sphere><radius>0.2</radius></sphere>", "3 0 0.2 0 0 0", false) +
      "</world></sdf>";
  Simulation simulation(load::world_from_text(text, "test", {}), 1, catalog);
  const auto samples = [&] {
    return simulation.snapshot()->reading(0)->get<std::int64_t>("samples");
  };
  for (int i = 0; i < 1100; ++i) simulation.tick();
  EXPECT_GE(samples(), 40);  // the fall takes 0.45 s
  for (int i = 0; i < 4000; ++i) simulation.tick();
  const std::int64_t resting = samples();
  for (int i = 0; i < 1000; ++i) {
    PushLink push;
    push.link = "ball::link";
    push.force = {0.2, 0.0, 0.0};
    push.time.duration = kSecond / 1000;
    simulation.post(push);
    simulation.tick();
  }
  EXPECT_EQ(simulation.snapshot()->counts.awake_bodies, 1U);
  EXPECT_EQ(samples(), resting);
  SetModelState up;
  up.model = "crate";
  up.state.pose = Pose{{0.0, 0.0, 2.0}, Quat::Identity()};
  simulation.post(up);
  for (int i = 0; i < 1000; ++i) simulation.tick();
  EXPECT_GE(samples(), resting + 60);  // the fall takes 0.62 s
}

}  // namespace
}  // namespace angen::sim

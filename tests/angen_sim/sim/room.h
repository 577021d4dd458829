#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "sdf/load.h"
#include "sim/simulation.h"

/// A room of sensors and movers, and the comparison of two runs in it.
namespace angen::sim {

inline std::string in_world(const std::string& inside) {
  return "<sdf version='1.6'><world name='w'>" + inside + "</world></sdf>";
}

inline std::unique_ptr<Simulation> simulation_of(
    const std::string& text, std::uint64_t seed = 0,
    const std::shared_ptr<Catalog>& catalog = std::make_shared<Catalog>(),
    const load::SearchPaths& paths = {}) {
  return std::make_unique<Simulation>(load::world_from_text(text, "test", paths), seed, catalog);
}

inline std::string ray_sensor(const std::string& name, const std::string& library, double rate,
                              double noise, const std::string& more = "") {
  const bool two = library == "liboptical_switch_controller.so";
  return "<sensor name='" + name + "' type='ray'><update_rate>" + std::to_string(rate) +
         "</update_rate><ray><scan><horizontal><samples>" + (two ? "2" : "12") +
         "</samples><min_angle>-0.6</min_angle><max_angle>0.6</max_angle></horizontal><vertical>"
         "<samples>" +
         (two ? "1" : "3") +
         "</samples><min_angle>-0.4</min_angle><max_angle>0.4</max_angle></vertical></scan>"
         "<range><min>0.02</min><max>5</max></range><noise><type>gaussian</type><mean>0</mean>"
         "<stddev>" +
         std::to_string(noise) + "</stddev></noise></ray><plugin name='p' filename='" + library +
         "'>" + more + "</plugin></sensor>";
}

inline std::string body(const std::string& name, const std::string& shape, const std::string& pose,
                        bool is_static, const std::string& sensors = "") {
  return "<model name='" + name + "'><static>" + (is_static ? "true" : "false") +
         "</static><pose>" + pose + "</pose><link name='link'><collision name='c'><geometry>" +
         shape + "</geometry></collision>" + sensors + "</link></model>";
}

inline const std::string kPir = "libpir_controller.so";
inline const std::string kNodding =
    "<nod_amplitude>0.3</nod_amplitude><nod_period>0.4</nod_period>";

/// A room in which things fall, roll and come to rest; sensors are fixed, nod, and ride on a
/// roller.
inline std::string room() {
  const std::string all_sensors =
      ray_sensor("plain", kPir, 20, 0.0) + ray_sensor("noisy", kPir, 10, 0.01) +
      ray_sensor("nodding", kPir, 10, 0.0, kNodding) +
      ray_sensor("noddingnoisy", kPir, 10, 0.02, kNodding) +
      ray_sensor("loud", kPir, 10, 0.05) +  // its noise alone is motion now and then
      ray_sensor("gate", "liboptical_switch_controller.so", 3, 0.0) +
      ray_sensor("gatenoisy", "liboptical_switch_controller.so", 3, 0.004);
  std::string text = body("floor", "<box><size>20 20 0.2</size></box>", "0 0 -0.1 0 0 0", true);
  text += body("wall", "<box><size>0.2 6 3</size></box>", "3 0 1.5 0 0 0", true);
  text += body("east", "<box><size>0.1 0.1 0.1</size></box>", "-3 0 0.6 0 0 0", true, all_sensors);
  text += body("west", "<box><size>0.1 0.1 0.1</size></box>", "2 -2 0.4 0 0 2.2", true,
               ray_sensor("plain", kPir, 10, 0.0) + ray_sensor("fast", kPir, 500, 0.0));
  text += body("roller", "<sphere><radius>0.2</radius></sphere>", "0 1 0.8 0 0 0.3", false,
               ray_sensor("riding", kPir, 10, 0.0));
  text += body("ball", "<sphere><radius>0.3</radius></sphere>", "-1 0.2 1.5 0 0 0", false);
  text += body("brick", "<box><size>0.4 0.2 0.6</size></box>", "0.5 -0.4 1.2 0.4 0.2 0", false);
  return in_world(text);
}

inline void expect_same_readings(const Snapshot& a, const Snapshot& b) {
  ASSERT_EQ(a.time, b.time);
  EXPECT_EQ(a.new_readings, b.new_readings) << a.time;
  EXPECT_EQ(a.counts.readings, b.counts.readings);
  for (std::size_t i = 0; i < a.sensors.size(); ++i) {
    const auto one = a.reading(i), other = b.reading(i);
    ASSERT_EQ(one == nullptr, other == nullptr);
    if (one == nullptr) continue;
    EXPECT_TRUE(one->same_values(*other)) << a.structure->sensors[i].name << " at " << a.time;
    EXPECT_EQ(a.stamp(i), b.stamp(i)) << a.structure->sensors[i].name << " at " << a.time;
  }
  ASSERT_EQ(a.events.size(), b.events.size()) << a.time;
  for (std::size_t i = 0; i < a.events.size(); ++i) {
    EXPECT_EQ(a.events[i].source, b.events[i].source);
    EXPECT_EQ(a.events[i].event, b.events[i].event);
    EXPECT_EQ(a.events[i].detail, b.events[i].detail);
  }
}

}  // namespace angen::sim

#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "sdf/load.h"
#include "sim/simulation.h"

/// Worlds that the benchmarks of `sim` run.
namespace angen::bench {

inline desc::World apartment() { return load::world(ANGEN_WORLDS_DIR "/angen.world"); }

inline std::unique_ptr<sim::Simulation> simulate(desc::World world) {
  static const auto catalog = std::make_shared<Catalog>();
  return std::make_unique<sim::Simulation>(std::move(world), 1, catalog);
}

inline bool is_person(const desc::Model& model) {
  return !model.plugins.empty() && model.plugins[0].filename == "libperson_controller.so";
}

inline void drop_persons(desc::World& world) {
  auto& models = world.models;
  models.erase(std::remove_if(models.begin(), models.end(), is_person), models.end());
}

inline void drop_sensors(desc::World& world) {
  for (desc::Model& model : world.models) {
    for (desc::Link& link : model.links) link.sensors.clear();
  }
}

/// The child called `name`, made where there is none.
inline Element& child(Element& element, const std::string& name) {
  for (Element& c : element.children) {
    if (c.name == name) return c;
  }
  element.children.emplace_back();
  element.children.back().name = name;
  return element.children.back();
}

inline void drop_ray_noise(desc::Sensor& sensor) {
  child(child(child(sensor.element, "ray"), "noise"), "type").text = "none";
}

inline void drop_ray_noise(desc::World& world) {
  for (desc::Model& model : world.models) {
    for (desc::Link& link : model.links) {
      for (desc::Sensor& sensor : link.sensors) {
        if (sensor.type == "ray") drop_ray_noise(sensor);
      }
    }
  }
}

/// As many people on the way of the world's own, one behind the other, half of them a floor up.
inline void put_persons(desc::World& world, int count) {
  const auto first = std::find_if(world.models.begin(), world.models.end(), is_person);
  const desc::Model one = *first;
  drop_persons(world);
  for (int i = 0; i < count; ++i) {
    desc::Model person = one;
    person.name += std::to_string(i);
    person.pose.position.z() += 4.0 * (i % 2);
    child(person.plugins[0].element, "delay_start").text = std::to_string(6.0 * (i / 2));
    world.models.push_back(std::move(person));
  }
}

/// A person's pose at `time` s on the way that its waypoints (t x y z yaw) describe.
inline Pose on_the_way(const desc::Model& person, double time) {
  std::vector<double> before, after;
  for (const Element& c : person.plugins[0].element.children) {
    if (c.name != "waypoint") continue;
    std::istringstream text(c.text);
    before = std::move(after);
    after.assign(std::istream_iterator<double>(text), {});
    if (after.at(0) > time) break;
  }
  const double part = (time - before.at(0)) / (after.at(0) - before.at(0));
  const auto between = [&](int i) { return before.at(i) + part * (after.at(i) - before.at(i)); };
  return {{between(1), between(2), between(3)}, from_rpy(0, 0, between(4))};
}

/// People on the way of the world's own, evenly along it, ten on a floor of 4 m.
inline void put_walkers(desc::World& world, int count) {
  constexpr int kOnFloor = 10;
  constexpr double kRound = 11.5;  // s, that the way takes
  const desc::Model one = *std::find_if(world.models.begin(), world.models.end(), is_person);
  drop_persons(world);
  for (int i = 0; i < count; ++i) {
    const double time = kRound * (i % kOnFloor) / kOnFloor;
    desc::Model person = one;
    person.name += std::to_string(i);
    person.pose = on_the_way(one, time);
    person.pose.position.z() += 4.0 * (i / kOnFloor);
    child(person.plugins[0].element, "path_time").text = std::to_string(time);
    world.models.push_back(std::move(person));
  }
}

/// A PIR of the world with 24 x 4 rays and no noise.
inline desc::Model quiet_pir(const desc::Model& pir) {
  desc::Model model = pir;
  drop_ray_noise(model.links[0].sensors[0]);
  Element& scan = child(child(model.links[0].sensors[0].element, "ray"), "scan");
  child(child(scan, "horizontal"), "samples").text = "24";
  child(child(scan, "vertical"), "samples").text = "4";
  return model;
}

inline bool nods(const desc::Model& pir) {
  for (const Element& c : pir.links[0].sensors[0].plugin_element.children) {
    if (c.name == "nod_amplitude") return true;
  }
  return false;
}

/// Puts `count` PIRs into the rooms: each beside one of the world's own that do not nod, and turned
/// a little.
inline void put_pirs(desc::World& world, int count) {
  std::vector<desc::Model> own;
  for (const desc::Model& model : world.models) {
    if (!model.links.empty() && !model.links[0].sensors.empty() &&
        model.links[0].sensors[0].plugin == "libpir_controller.so" && !nods(model)) {
      own.push_back(quiet_pir(model));
    }
  }
  drop_sensors(world);
  Rng rng(1, hash_bytes("pirs"), 0);
  for (int i = 0; i < count; ++i) {
    desc::Model pir = own[static_cast<std::size_t>(i) % own.size()];
    pir.name = "bench_pir" + std::to_string(i);
    const double along = rng.uniform(), down = rng.uniform(), turn = rng.uniform();
    pir.pose.position += pir.pose.rotation * Vec3(0.02 + 0.3 * along, 0.0, -0.1 * down);
    pir.pose.rotation = pir.pose.rotation * from_rpy(0, 0, 0.4 * (turn - 0.5));
    world.models.push_back(std::move(pir));
  }
}

}  // namespace angen::bench

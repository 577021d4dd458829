#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "desc/world.h"
#include "home/survey.h"
#include "plugin/plugin.h"
#include "sim/fault.h"
#include "sim/schedule.h"
#include "sim/shared_array.h"

namespace angen::sim {

/// One change worth publishing.
struct Event {
  Nanoseconds stamp = 0;
  std::string source;  // "bathroom1"
  std::string kind;    // "door", "pir", "world", …
  std::string event;   // "opened", "motion", "rejected", "spawned", …
  std::string detail;
};

struct LinkEntry {
  std::string name;  // model::link
  std::uint32_t model = 0;
  std::uint32_t link = 0;  // index in desc::Model::links
  bool moves = false;      // not static
};

struct JointEntry {
  std::string name;  // model::joint
  std::uint32_t model = 0;
  std::uint32_t joint = 0;  // index in desc::Model::joints
};

/// Properties of a device that stay the same as long as it exists.
struct DeviceInfo {
  std::string kind;
  std::string name;
  std::shared_ptr<const Plugin> plugin;  // describes the kind, and keeps its library loaded
  std::string library;                   // the plug-in's library, as its SDF names it
  std::string joint{};  // the joint of its model that it moves, if it has one of several
  int body = -1;        // the number of the link of its model whose anatomy it declares; -1: none
};

struct DeviceEntry : DeviceInfo {
  std::uint32_t model = 0;           // UINT32_MAX: of a light of the world's own
  std::uint32_t light = UINT32_MAX;  // the light, in Structure::lights
};

/// Properties of a sensor that stay the same as long as it exists.
struct SensorInfo {
  std::string kind;
  std::string name;
  Pose pose;              // in the link's frame
  std::string topic;      // from its SDF, or empty
  std::string frame;      // from its SDF, or empty
  std::uint64_t key = 0;  // key of its random numbers
  bool attached = false;  // by a command, to a link that existed
  std::shared_ptr<const desc::Sensor> desc;
  std::shared_ptr<const RayGeometry> rays;  // null: it has no grid of rays
  std::shared_ptr<const Plugin> plugin;     // describes the kind, and keeps its library loaded
  Schedule schedule;                        // schedule of all its due times
  std::vector<Fault> faults;                // faults that its SDF names

  /// Samples only while requested, see Simulation::request.
  bool on_demand() const { return plugin->kind().is_on_demand; }
};

/// KIND/NAME of a device or sensor.
template <class Instance>
std::string full_name(const Instance& instance) {
  return instance.kind + "/" + instance.name;
}

struct SensorEntry : SensorInfo {
  std::uint32_t model = 0;
  std::uint32_t link = 0;  // index in Structure::links
};

struct LightEntry {
  std::string name;                  // model::light, or the light's own name for a world light
  std::uint32_t model = UINT32_MAX;  // none for a world light
  std::uint32_t link = UINT32_MAX;   // index in Structure::links
  desc::Light light;
};

/// All parts of the world. Replaced, never changed, by a spawn or a deletion; the next shares what
/// kept its numbers.
struct Structure {
  std::uint64_t revision = 0;
  std::vector<std::shared_ptr<const desc::Model>> models;
  SharedArray<LinkEntry> links;
  SharedArray<JointEntry> joints;
  SharedArray<DeviceEntry> devices;
  SharedArray<SensorEntry> sensors;
  SharedArray<LightEntry> lights;
  std::vector<std::shared_ptr<const Plugin>>
      device_plugins;                       // plug-ins of each kind that there is or may be
  desc::Physics physics;                    // present settings
  Vec3 gravity = Vec3::Zero();              // m/s^2
  std::vector<Storey> storeys;              // result of storeys_of()
  std::shared_ptr<const DerivedHome> home;  // home of these models

  const desc::Link& described(const LinkEntry& link) const {
    return models[link.model]->links[link.link];
  }
  const desc::Joint& described(const JointEntry& joint) const {
    return models[joint.model]->joints[joint.joint];
  }
  /// The index in `links` of a model's first one: each model has one, and they are in its order.
  std::uint32_t first_link(std::uint32_t model) const;
};

struct Counts {
  std::uint32_t awake_bodies = 0;
  std::uint64_t readings = 0;      // made since the start
  std::uint64_t failed_steps = 0;  // redone by the other solver
};

/// Where limbs are in the frame of their link, as Anatomy::limbs; null: as the model has them.
using LimbPoses = std::shared_ptr<const std::vector<Pose>>;

/// The reading that a sensor published last, and the lazy reading that replaces its samples since.
struct PublishedReading {
  std::shared_ptr<const Reading> reading;   // null before the first
  std::shared_ptr<const LazyReading> lazy;  // null if it is the reading itself
  Nanoseconds stamp = -1;                   // a faulty sensor's; else by its schedule
};

/// The world after a tick. Shared and immutable; parts that did not change are shared with the
/// snapshot before, so that comparing pointers shows the changes.
struct Snapshot {
  std::int64_t tick = 0;
  Nanoseconds time = 0;
  Nanoseconds step = 0;
  std::uint64_t seed = 0;
  bool paused = false;
  std::shared_ptr<const Structure> structure;
  SharedArray<Pose> link_poses;         // world, as Structure::links
  SharedArray<double> joint_positions;  // rad or m, as Structure::joints, first axis
  SharedArray<std::shared_ptr<const Reading>> devices;  // indexed like Structure::devices
  SharedArray<LimbPoses> limbs;           // limbs of their bodies, indexed like devices
  SharedArray<PublishedReading> sensors;  // indexed like Structure::sensors; see reading()
  std::shared_ptr<const std::vector<double>> light_levels;  // 0..1, as Structure::lights
  std::vector<std::uint32_t> moved_links;   // indices of links whose pose changed in this tick
  std::vector<std::uint32_t> new_readings;  // indices of sensors that published in this tick: a
                                            // reading of now, or again the last, if nothing changed
  std::vector<std::uint32_t> new_states;    // indices of devices whose state changed in this tick
  std::vector<Event> events;                // events of this tick
  Counts counts;

  /// When a sensor that has a reading last published it: its own stamp, or the due time that found
  /// nothing changed since.
  Nanoseconds stamp(std::size_t sensor) const;

  /// The last publication of a sensor, null before the first. Its own stamp may be earlier than
  /// stamp(): it is valid until the next.
  std::shared_ptr<const Reading> reading(std::size_t sensor) const;
};

}  // namespace angen::sim

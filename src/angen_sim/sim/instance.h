#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "plugin/library.h"
#include "sim/snapshot.h"
#include "sim/stage.h"

namespace angen::sim {

struct DeviceInstance {
  std::string kind;
  std::string name;
  std::shared_ptr<const Plugin> plugin;  // keeps its library loaded
  std::unique_ptr<Device> device;
  Reading scratch;  // what it reports is written here, then compared
  std::shared_ptr<const Reading> last;
};

struct SensorInstance {
  std::string kind;
  std::string name;
  std::uint64_t key = 0;  // of its random numbers
  std::shared_ptr<const Plugin> plugin;
  std::unique_ptr<Sensor> sensor;
  std::shared_ptr<const desc::Sensor> desc;
  std::uint32_t link = 0;  // in its model
  Pose pose;               // in the link's frame
  std::string topic;
  std::string frame;
  bool attached = false;
  std::vector<std::string> collisions;  // full names, by ContactRef
  Nanoseconds period = 0;               // of publishing
  Nanoseconds sample_period = 0;        // of looking
  Nanoseconds start = 0;
  std::int64_t samples = 0;  // due times are start + k * period, k counted
  std::int64_t published = 0;
  Reading scratch;
  std::shared_ptr<const Reading> last;

  Nanoseconds next_sample() const { return start + samples * sample_period; }
  Nanoseconds next_publish() const { return start + published * period; }
};

/// A model that is in the world, with all that acts and looks in it.
struct LiveModel {
  std::shared_ptr<const desc::Model> desc;
  Parts parts;
  std::vector<DeviceInstance> devices;
  std::vector<SensorInstance> sensors;
  std::uint32_t first_link = 0;  // index of its first link in Structure::links
  std::uint32_t first_joint = 0;
  std::uint32_t first_device = 0;
  std::uint32_t first_sensor = 0;
  std::uint32_t first_light = 0;
};

ModelInfo info_of(const desc::Model& model);

/// What a model's plug-ins and the world's make of it, not yet in the world. Throws Error for a
/// plug-in or parameter that is wrong; `warnings` tells of sensors without a plug-in.
void make_instances(LiveModel& live, const std::vector<desc::Plugin>& world_plugins,
                    const Vec3& gravity, Catalog& catalog, std::vector<std::string>& warnings);

/// A sensor of `live`, on its link number `link`.
SensorInstance make_sensor(const LiveModel& live, std::uint32_t link, const desc::Sensor& described,
                           const std::string& name, const Vec3& gravity, Catalog& catalog);

}  // namespace angen::sim

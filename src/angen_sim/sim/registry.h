#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "sim/instance.h"

namespace angen::sim {

/// Models by their names and by those of their devices and sensors. Names of a kind differ.
class Registry {
 public:
  /// Throws Error if the model, or one of its devices or sensors, has a name that is there.
  void check(const LiveModel& live) const;
  void check(const SensorInstance& sensor) const;

  void add(LiveModel& live);
  void add(const SensorInstance& sensor, LiveModel& live) { sensors_[full_name(sensor)] = &live; }
  void remove(const LiveModel& live);
  void remove(const SensorInstance& sensor) { sensors_.erase(full_name(sensor)); }
  void clear() { *this = {}; }

  /// Null if there is none; a light of the world is none.
  LiveModel* model(const std::string& name) const;
  /// The model with that device or sensor; null if there is none.
  LiveModel* with_device(const std::string& kind, const std::string& name) const;
  LiveModel* with_sensor(const std::string& kind, const std::string& name) const;
  /// The models with devices of that name, of any kind, in the order in which they were added.
  std::vector<LiveModel*> with_devices(const std::string& name) const;

 private:
  using ByName = std::unordered_map<std::string, LiveModel*>;

  static LiveModel* find(const ByName& all, const std::string& name);

  ByName models_;
  ByName devices_;                                                        // by full name
  ByName sensors_;                                                        // by full name
  std::unordered_map<std::string, std::vector<LiveModel*>> with_device_;  // by the device's name
};

}  // namespace angen::sim

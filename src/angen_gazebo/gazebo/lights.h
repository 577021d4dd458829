#pragma once

#include <map>
#include <mutex>
#include <string>

#include "gazebo/server.h"
#include "ros/inbox.h"

namespace angen::node::gazebo {

/// get_light_properties, set_light_properties, delete_light. Attenuation, which light does by
/// itself here, and the alpha of colors are kept and answered.
class Lights {
 public:
  explicit Lights(Server& server);
  /// A light was spawned from this SDF.
  void note_spawned(const std::string& name, const std::string& sdf);

 private:
  struct Unused {
    float alpha = 1.0F;
    double constant = 1.0;
    double linear = 1.0;
    double quadratic = 0.0;
  };
  static void read_attenuation(const Element& light, Unused& to);
  /// The light as it was set or spawned; else as its SDF says.
  Unused unused_of(const sim::Structure& structure, const sim::LightEntry& light);

  Inbox& inbox_;
  std::mutex mutex_;  // guards unused_
  std::map<std::string, Unused> unused_;
};

}  // namespace angen::node::gazebo

#pragma once

#include <string>
#include <vector>

#include "desc/world.h"
#include "plugin/library.h"
#include "ros/topics.h"

namespace angen::node {

/// A sensor that is to be spawned, under the name that it will have.
struct NewSensor {
  std::string name;
  const desc::Sensor* described = nullptr;
};

/// Topics of a model.
std::vector<NewSensor> new_sensors(const desc::Model& model);

/// Throws Error if one of them would publish on a topic of this node that carries another type of
/// message. Topics under a robot's name are not checked. Any thread.
void check_topics(const std::vector<NewSensor>& sensors, Catalog& catalog, Topics topics);

}  // namespace angen::node

#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/node_handle.h>

#include <mutex>

#include "gazebo/physics.h"

namespace angen::node::gazebo {

/// The physics properties as parameters of dynamic_reconfigure: parameter_descriptions and
/// parameter_updates, latched, and set_parameters.
class Reconfigure {
 public:
  Reconfigure(ros::NodeHandle node, PhysicsProperties& physics);

 private:
  using Call = dynamic_reconfigure::Reconfigure;

  bool set(Call::Request& request, Call::Response& response);
  void publish();

  PhysicsProperties& physics_;
  std::mutex mutex_;  // the last update published is of the last change
  ros::Publisher descriptions_;
  ros::Publisher updates_;
  ros::ServiceServer server_;
};

}  // namespace angen::node::gazebo

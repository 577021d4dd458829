#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <gazebo_msgs/GetPhysicsProperties.h>
#include <gazebo_msgs/SetPhysicsProperties.h>
#include <ros/node_handle.h>

#include <atomic>
#include <functional>
#include <mutex>

#include "gazebo/server.h"
#include "ros/inbox.h"

namespace angen::node::gazebo {

/// get_physics_properties and set_physics_properties. Values that Angen's solver does not use are
/// kept and answered.
class PhysicsProperties {
 public:
  /// `rate` is that of the node: simulated seconds per wall second, 0 for no limit.
  PhysicsProperties(Server& server, std::atomic<double>& rate);

  gazebo_msgs::GetPhysicsProperties::Response get();
  /// Returns the part without effect, "" if there is none. Throws Error and changes nothing.
  std::string set(const gazebo_msgs::SetPhysicsProperties::Request& request);
  /// Called after each change; of one listener.
  void on_change(std::function<void()> changed) { changed_ = std::move(changed); }

 private:
  struct Unused {
    bool auto_disable_bodies = true;
    std::uint32_t precon_iters = 0;
    double w = 1.3;
    double rms_error_tol = 0.0;
    std::uint32_t max_contacts = 20;
  };

  Inbox& inbox_;
  std::atomic<double>& rate_;
  std::mutex mutex_;  // guards unused_
  Unused unused_;
  std::function<void()> changed_;
};

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

#pragma once

#include "gazebo/joint_control.h"
#include "gazebo/lights.h"
#include "gazebo/performance.h"
#include "gazebo/physics.h"
#include "gazebo/reconfigure.h"
#include "gazebo/server.h"
#include "gazebo/spawn.h"
#include "gazebo/states.h"
#include "ros/extension.h"

namespace angen::node::gazebo {

/// The services and topics of gazebo_ros, but for services that std_srvs/Empty has
/// (node/services.h), and the controllers of joints.
class Api : public Extension {
 public:
  explicit Api(const ExtensionParts& parts);

  void on_structure(const sim::Structure& structure, const Changes& changes) override;
  void publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now) override;
  void control(const sim::Snapshot& snapshot) override { controls_.update(snapshot); }
  bool needs_ticks() const override { return !controls_.empty(); }

 private:
  load::SearchPaths paths_;
  Server server_;
  Lights lights_;
  Spawner spawner_;
  PhysicsProperties physics_;
  Reconfigure reconfigure_;
  StateTopics states_;
  Performance performance_;
  JointControls controls_;
};

}  // namespace angen::node::gazebo

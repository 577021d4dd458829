#include "gazebo/joint_control.h"
#include "gazebo/lights.h"
#include "gazebo/physics.h"
#include "gazebo/server.h"
#include "gazebo/services.h"
#include "gazebo/spawn.h"
#include "gazebo/states.h"
#include "ros/extension.h"

namespace angen::node::gazebo {

namespace {

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

const ExtensionRegistration registration([](const ExtensionParts& parts) {
  return std::unique_ptr<Extension>(std::make_unique<Api>(parts));
});

}  // namespace

Api::Api(const ExtensionParts& parts)
    : paths_(load::SearchPaths::from_environment(parts.models)),
      server_(parts.services, parts.inbox),
      lights_(server_),
      spawner_(server_, paths_, parts.per, lights_),
      physics_(server_, parts.rate),
      reconfigure_(parts.services, physics_),
      states_(parts.topics, parts.inbox, parts.states_rate),
      performance_(parts.topics, parts.simulation),
      controls_(parts.simulation) {
  serve_models(server_);
  serve_links(server_);
  serve_joints(server_);
}

void Api::on_structure(const sim::Structure& structure, const Changes& changes) {
  controls_.on_structure(structure, changes);
}

void Api::publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now) {
  states_.publish(snapshot, now);
  performance_.publish(snapshot, now);
}

}  // namespace angen::node::gazebo

#include "gazebo/api.h"

#include "gazebo/joints.h"
#include "gazebo/links.h"
#include "gazebo/models.h"

namespace angen::node::gazebo {

namespace {

const ExtensionRegistration registration([](const ExtensionParts& parts) {
  return std::unique_ptr<Extension>(std::make_unique<Api>(parts));
});

}  // namespace

Api::Api(const ExtensionParts& parts)
    : paths_(load::SearchPaths::from_environment(parts.models)),
      server_(parts.services),
      lights_(server_, parts.inbox),
      spawner_(server_, parts.inbox, paths_, parts.per, lights_),
      physics_(server_, parts.inbox, parts.rate),
      reconfigure_(parts.services, physics_),
      states_(parts.topics, parts.inbox, parts.states_rate),
      performance_(parts.topics, parts.simulation),
      controls_(parts.simulation) {
  serve_models(server_, parts.inbox);
  serve_links(server_, parts.inbox);
  serve_joints(server_, parts.inbox);
}

void Api::on_structure(const sim::Structure& structure, const Changes& changes) {
  controls_.on_structure(structure, changes);
}

void Api::publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now) {
  states_.publish(snapshot, now);
  performance_.publish(snapshot, now);
}

}  // namespace angen::node::gazebo

#pragma once

#include <string>
#include <vector>

#include "core/time.h"
#include "physics/world.h"

namespace angen::sim {

class Building;
struct LiveModel;

/// A model, a link (model::link) or a collision (model::link::collision) by its full name.
struct Entity {
  LiveModel* model = nullptr;
  std::uint32_t link = 0;  // a model's first
  Pose in_link;
  bool is_model = false;
};

struct Motion {
  Pose pose;
  Vec3 linear = Vec3::Zero();   // m/s, of its origin, in the world
  Vec3 angular = Vec3::Zero();  // rad/s
};

/// Throw Error if there is none of that name. "" is no entity.
Entity find_entity(const Building& building, const std::string& name);
Entity find_link(const Building& building, const std::string& name);

struct FoundJoint {
  LiveModel* model = nullptr;
  std::uint32_t joint = 0;
};
FoundJoint find_joint(const Building& building, const std::string& name);  // model::joint

Motion motion_of(const Building& building, const Entity& entity);
/// The motion of an entity, that of the world for "".
Motion motion_of(const Building& building, const std::string& name);

/// The answer to a query of the thread that ticks.
struct Observed {
  Nanoseconds time = 0;
  std::vector<Motion> entities;
  std::vector<physics::JointState> joints;
};

/// The states of entities ("": the world) and joints now.
struct Observation {
  std::vector<std::string> entities;
  std::vector<std::string> joints;
};
Observed observe(const Building& building, const Observation& observation);

}  // namespace angen::sim

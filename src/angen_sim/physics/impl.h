#pragma once

#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/slots.h"
#include "physics/contacts.h"
#include "physics/grid.h"
#include "physics/model.h"
#include "physics/shapes.h"
#include "physics/solver.h"
#include "physics/world.h"

namespace angen::physics {

/// The parts of World. Members are destroyed from the last to the first: the ODE world is destroyed
/// last.
struct World::Impl {
  Impl(const desc::Physics& settings, const Vec3& gravity, std::uint64_t seed);

  ModelId add(const desc::Model& model);
  void remove(ModelId id);
  /// A step of `count` times h.
  void take_step(std::int64_t tick, std::int64_t count);
  void wake(Body& body);
  void wake_joint(const Joint& joint);
  /// Wakes sleeping bodies whose boxes overlap those of a model that came, left or moved.
  void wake_near(ModelRecord& model);
  void settle(ModelRecord& model, const Pose& pose);
  /// Lets ODE have a body that is awake.
  void give_to_ode(Body& body);
  /// A world of ODE's with nothing in it, and the settings.
  void make_ode_world();
  void give_settings();
  /// Inserts a mechanism into ODE again, at rest, its bodies at their poses.
  void reinsert(Mechanism& mechanism);
  /// Before and after a model's bodies are put elsewhere.
  void leave(ModelRecord& model);
  void arrive(ModelRecord& model);
  void note_placed(const ModelRecord& model);
  Joint& joint_at(JointId id) { return *joints.at(id); }

  double h;  // s
  desc::Physics settings;
  Vec3 gravity;
  std::uint64_t seed;
  ode::ThreadingHandle threading;  // its own: a failed step leaves jobs in it
  ode::WorldHandle world;
  ShapeFactory shapes;
  std::uint64_t serial = 0;
  std::uint64_t steps = 0;
  std::uint64_t failed = 0;
  Slots<std::unique_ptr<ModelRecord>, PhysicsModelTag> models;
  Slots<LinkRecord, PhysicsLinkTag> links;
  Slots<Joint*, PhysicsJointTag> joints;
  std::unordered_map<std::string, const Geom*> geoms;  // by name
  Slots<Geom*, PhysicsCollisionTag> collisions;
  Grid grid;
  Contacts contacts;
  std::vector<Body*> awake;
  std::vector<LinkId> moved;
  std::vector<LinkId> placed;  // since the last step
  Trouble trouble;
  std::vector<Stopped> stopped;
  bool crowded = false;
  bool has_large_islands = false;
  std::vector<ContactPair> listed;
  bool list_is_old = false;

 private:
  void collide();
  void collide_body(Body& body);
  void add_lift();
  void set_up_joints(double step);
  void integrate(std::int64_t tick, double step);
  using Solve = std::function<void(const std::vector<Body*>&)>;
  void solve_again(const std::vector<BodyState>& start, bool push, const Solve& solve);
  void agree_on_friction(const std::vector<BodyState>& start, const Solve& solve);
  void renew();
  void read_bodies(double step);
  /// Corrects positions after a long step, which moves bodies at their final speed all along.
  void take_back(const std::vector<Vec3>& before, double step);
};

}  // namespace angen::physics

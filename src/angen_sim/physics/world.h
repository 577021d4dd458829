#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/contact.h"
#include "core/id.h"
#include "desc/world.h"

/// Rigid bodies by ODE. One thread. SI units, world frame unless said otherwise. Links held
/// together by fixed joints are one body; one fixed to the world, or kinematic, is static.
/// Bodies that touch or are jointed fall asleep together when all have been slower than 0.01 m/s
/// and 0.01 rad/s for 0.5 s. Links of one model touch only if it collides with itself, parent and
/// child of a joint never. The same calls give the same bits, whatever other worlds there are.
/// Ids that were removed throw std::out_of_range.
namespace angen::physics {

using ModelId = Id<struct PhysicsModelTag>;
using LinkId = Id<struct PhysicsLinkTag>;
using CollisionId = Id<struct PhysicsCollisionTag>;
using JointId = Id<struct PhysicsJointTag>;

struct LinkState {
  Pose pose;                             // the link's frame (not its center of mass)
  Vec3 linear_velocity = Vec3::Zero();   // m/s at the link's origin
  Vec3 angular_velocity = Vec3::Zero();  // rad/s
};

struct JointState {
  double position = 0.0;  // rad or m, first axis
  double velocity = 0.0;
  double effort =
      0.0;  // N m or N along the axis that joint and motor gave the child in the last step
};

/// Force and torque of a joint's child on its parent in the last step.
struct Wrench {
  Vec3 force = Vec3::Zero();   // N
  Vec3 torque = Vec3::Zero();  // N m, about the joint's anchor
};

/// A link whose mechanism was put to sleep for good because it would have left the
/// limits.
struct Stopped {
  LinkId link;
  std::string why;
};

class World {
 public:
  World(const desc::Physics& settings, const Vec3& gravity, std::uint64_t seed);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Adds bodies, joints and shapes; throws Error and adds nothing when the model cannot be built.
  ModelId add(const desc::Model& model);
  void remove(ModelId model);

  /// Ids in the order of desc::Model::links and ::joints.
  const std::vector<LinkId>& links(ModelId model) const;
  const std::vector<JointId>& joints(ModelId model) const;

  LinkState link(LinkId link) const;
  Pose pose(LinkId link) const;    // the link's frame
  double mass(LinkId link) const;  // kg, 0 for static links
  bool awake(LinkId link) const;   // false for static and sleeping ones
  void wake(LinkId link);
  JointState joint(JointId joint) const;
  /// With the forces of its motor, its spring and add_force(). Of a fixed joint,
  /// whose links are one body, it is zero.
  Wrench wrench(JointId joint) const;

  /// Force (prismatic, N) or torque (revolute, N m) for the next step only; wakes the child unless
  /// 0.
  void add_force(JointId joint, double force);

  /// A velocity-controlled motor with a force limit (N m or N), until changed; max_force 0 frees
  /// it. Velocity 0 is a brake: bodies may fall asleep under it. Wakes bodies when it changes.
  void set_motor(JointId joint, double velocity, double max_force);

  /// Holds a revolute or prismatic joint where it is, whatever its axis' limit of effort, against
  /// less than `break_force` (N m or N, averaged over 0.1 s; infinite: against anything), until
  /// unlatch(). Wakes bodies when it changes.
  void latch(JointId joint, double break_force);
  void unlatch(JointId joint);

  /// Drives a link in the plane: horizontal velocity (m/s) and yaw rate (rad/s) held by a motor of
  /// at most max_force (N, in any direction); z stays free. max_force 0 frees it. Wakes when it
  /// changes.
  void drive(LinkId link, const Vec3& velocity, double yaw_rate, double max_force);

  /// A force (N) at a point (world, m) and a torque (N m) on a link for the next step only. Wakes a
  /// sleeping body unless both are 0; an awake one may fall asleep under the same push.
  void push(LinkId link, const Vec3& force, const Vec3& torque, const Vec3& point);

  /// Moves a whole model, also a static one, by a displacement in the world; joints keep their
  /// positions; it is at rest then. Throws Error for a place beyond the limits.
  void move(ModelId model, const Pose& by);
  /// Moves a link and all that is joined to it. Throws Error if a joint holds it to something
  /// static.
  void move(LinkId link, const Pose& by);
  /// Whether a collision touches others from now on; wakes its body.
  void set_touches(CollisionId collision, bool touches);
  /// Sets the velocity of a link's origin, and of links fixed to it; wakes it.
  void set_velocity(LinkId link, const Vec3& linear, const Vec3& angular);
  /// Puts joints where they have a position, within their limits (rad or m, as ids from joints());
  /// child links move along, and have the velocity of their parent then. Throws Error for a joint
  /// without exactly one axis, or in a loop.
  void arrange(ModelId model, const std::vector<std::optional<double>>& positions);
  /// Inertials, gravity of links and axes of joints are as described from now on; all else must
  /// be as the model was. Throws Error as add() does.
  void redescribe(ModelId model, const desc::Model& described);
  /// Gravity and the solver's settings from now on; the step stays. Wakes everything.
  void set(const desc::Physics& settings, const Vec3& gravity);

  /// Collides and integrates one step of settings.step. `tick` keys the random numbers that the
  /// solver needs.
  void step(std::int64_t tick) { step(tick, 1); }
  /// Collides and integrates one step that is `count` times as long, at most longest_step().
  void step(std::int64_t tick, std::int64_t count);

  /// How many times as long a step may be, at most `most`. It is 1 unless each awake body never
  /// tilts and touches only the ground below it, is loose and has been at rest for 0.05 s, or hangs
  /// on one joint that is led, and touches nothing.
  std::int64_t longest_step(std::int64_t most) const;

  /// Links that the last step stopped: they stay at their poses before the step, like static
  /// bodies, until their model is moved.
  const std::vector<Stopped>& stopped() const;

  /// True if there were too many contacts in the last step (20,000 points), and some of two moving
  /// bodies were left out.
  bool crowded() const;

  /// Links whose pose changed in the last step, or since, in id order.
  const std::vector<LinkId>& moved() const;

  /// All contacts, sorted by names' ids; sleeping bodies keep their last contacts and forces.
  const std::vector<ContactPair>& contacts() const;
  /// By its name, model::link::collision; not valid for one that has no shape or does not exist.
  CollisionId collision(const std::string& name) const;
  /// The contacts of this collision, turned so that it is the first.
  std::vector<ContactPair> contacts(CollisionId collision) const;
  /// Its contacts, and its last contact with each collision that touched it since tick `first`,
  /// counted from the first call on.
  std::vector<ContactPair> contacts_since(CollisionId collision, std::int64_t first);
  /// Grows whenever contacts() may have changed.
  std::uint64_t contacts_revision(CollisionId collision) const;

  std::uint64_t failed_steps() const;  // steps that had to be redone by the other solver
  std::size_t awake_count() const;
  /// Adds the links of all awake bodies.
  void list_awake(std::vector<LinkId>& links) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace angen::physics

// Changes of a model in the world besides steps: its place, motion, joints, masses.
#include <algorithm>
#include <map>

#include "core/diagnostics.h"
#include "core/limits.h"
#include "core/lists.h"
#include "physics/build.h"
#include "physics/impl.h"
#include "physics/joints.h"
#include "physics/sleep.h"

namespace angen::physics {

namespace {

struct Motion {
  Vec3 velocity = Vec3::Zero();  // the center of mass'
  Vec3 spin = Vec3::Zero();
};

Motion motion_of(const Body& body) { return {body.velocity(), body.spin()}; }

// The motion of a body that is carried by another one as if both were one.
Motion carried(const Motion& by, const Pose& other, const Pose& body) {
  return {by.velocity + by.spin.cross(body.position - other.position), by.spin};
}

void set_motion(const Body& body, const Motion& motion) {
  const Vec3& v = motion.velocity;
  const Vec3& w = motion.spin;
  dBodySetLinearVel(body.ode.get(), v.x(), v.y(), v.z());
  dBodySetAngularVel(body.ode.get(), w.x(), w.y(), w.z());
}

void check_place(const ModelRecord& model, const Pose& at) {
  const std::string problem = pose_problem(at);
  if (problem.empty()) return;
  throw Error("model \"" + model.name + "\" cannot be put there: " + problem);
}

/// Poses and velocities of a model's bodies with its joints at other positions.
class Arrangement {
 public:
  Arrangement(const ModelRecord& model, const std::vector<std::optional<double>>& positions)
      : model_(model) {
    for (std::size_t i = 0; i < model.joints.size(); ++i) {
      if (positions.at(i)) goals_[model.joints[i].get()] = goal_of(*model.joints[i], *positions[i]);
    }
    std::size_t reached = 0;
    for (const auto& body : model.bodies) {
      if (!hangs(*body)) add(*body, {{}, motion_of(*body)});
    }
    for (std::size_t i = 0; i < order_.size(); ++i) {
      for (Joint* joint : order_[i]->joints) reached += follow(*order_[i], *joint) ? 1 : 0;
    }
    if (reached < goals_.size()) {
      throw Error("model \"" + model.name +
                  "\" has a loop of joints; their positions cannot be set");
    }
  }

  struct Placed {
    Pose moved;  // from its place, in the world
    Motion motion;
  };
  const Placed& of(Body* body) const { return placed_.at(body); }
  bool has(Body* body) const { return placed_.count(body) != 0; }
  const std::map<Joint*, double>& goals() const { return goals_; }

 private:
  static bool hangs(const Body& body) {
    return std::any_of(body.joints.begin(), body.joints.end(),
                       [&](const Joint* joint) { return joint->first == &body; });
  }

  double goal_of(const Joint& joint, double position) const {
    using Type = desc::Joint::Type;
    const bool none = joint.type == Type::kFixed || joint.type == Type::kBall;
    if (none || joint.type == Type::kUniversal) {
      throw Error("joint \"" + model_.name + "::" + joint.name +
                  "\" has not one axis; its position cannot be set");
    }
    return std::clamp(position, joint.axes[0].lower, joint.axes[0].upper);
  }

  void add(Body& body, const Placed& placed) {
    if (placed_.emplace(&body, placed).second) order_.push_back(&body);
  }

  // Whether the joint has a goal, and its child is at that pose.
  bool follow(Body& parent, Joint& joint) {
    if (joint.second != &parent || placed_.count(joint.first) != 0) return false;
    const Placed of_parent = placed_.at(&parent);
    const auto goal = goals_.find(&joint);
    Placed child{of_parent.moved, motion_of(*joint.first)};
    if (goal != goals_.end()) {
      child.moved = of_parent.moved * joint_step(joint, goal->second - joint.position);
    }
    if (goal != goals_.end() || !(of_parent.moved == Pose{})) {
      child.motion =
          carried(of_parent.motion, of_parent.moved * parent.at, child.moved * joint.first->at);
    }
    check_place(model_, child.moved * joint.first->at);
    add(*joint.first, child);
    return goal != goals_.end();
  }

  const ModelRecord& model_;
  std::map<Joint*, double> goals_;
  std::map<Body*, Placed> placed_;
  std::vector<Body*> order_;
};

}  // namespace

void World::Impl::reinsert(Mechanism& mechanism) {
  take_out(mechanism);
  mechanism.stopped = false;
  insert(world.get(), mechanism);
  // ODE normalizes the quaternion once more.
  for (Body* body : mechanism.bodies) {
    body->at.rotation = ode::quat(dBodyGetQuaternion(body->ode.get()));
  }
}

void World::Impl::leave(ModelRecord& model) {
  contacts.drop(model, [&](Body& body) { wake(body); });
  list_is_old = true;
}

void World::Impl::arrive(ModelRecord& model) {
  for (const auto& geom : model.geoms) {
    follow_body(*geom);
    grid.update(*geom);
  }
  for (const auto& body : model.bodies) wake(*body);
  wake_near(model);
  note_placed(model);
}

void World::Impl::note_placed(const ModelRecord& model) {
  placed.insert(placed.end(), model.link_ids.begin(), model.link_ids.end());
  moved.insert(moved.end(), model.link_ids.begin(), model.link_ids.end());
  sort_unique(moved);
}

void World::move(ModelId id, const Pose& by) {
  ode::prepare_thread();
  ModelRecord& model = *impl_->models.at(id);
  for (const auto& body : model.bodies) check_place(model, by * body->at);
  check_place(model, by * model.pose);
  impl_->leave(model);
  model.pose = by * model.pose;
  for (const auto& body : model.bodies) {
    body->at = by * body->at;
    body->upright_at = body->at.rotation;
  }
  for (const auto& mechanism : model.mechanisms) impl_->reinsert(*mechanism);
  impl_->arrive(model);
}

void World::move(LinkId id, const Pose& by) {
  Body& body = *impl_->links.at(id).body;
  ModelRecord& model = *body.model;
  if (!body.dynamic()) throw Error("a static link of model \"" + model.name + "\" cannot be moved");
  ode::prepare_thread();
  for (const Joint* joint : body.mechanism->joints) {
    if (joint->second->dynamic()) continue;
    throw Error("joint \"" + model.name + "::" + joint->name +
                "\" holds the link; set the joint's position, or move the model");
  }
  for (const Body* part : body.mechanism->bodies) check_place(model, by * part->at);
  impl_->leave(model);
  for (Body* part : body.mechanism->bodies) {
    part->at = by * part->at;
    part->upright_at = part->at.rotation;
  }
  impl_->reinsert(*body.mechanism);
  impl_->arrive(model);
}

void World::set_velocity(LinkId id, const Vec3& linear, const Vec3& angular) {
  const LinkRecord& link = impl_->links.at(id);
  Body& body = *link.body;
  if (!body.dynamic()) return;
  impl_->wake(body);
  if (!body.awake) return;  // it has been stopped
  impl_->give_to_ode(body);
  set_motion(body, carried({linear, angular}, body.at * link.in_body, body.at));
}

void World::arrange(ModelId id, const std::vector<std::optional<double>>& positions) {
  ode::prepare_thread();
  ModelRecord& model = *impl_->models.at(id);
  const Arrangement arrangement(model, positions);
  impl_->leave(model);
  for (const auto& body : model.bodies) {
    if (arrangement.has(body.get())) body->at = arrangement.of(body.get()).moved * body->at;
  }
  for (const auto& mechanism : model.mechanisms) impl_->reinsert(*mechanism);
  for (const auto& body : model.bodies) {
    if (body->ode != nullptr && arrangement.has(body.get())) {
      set_motion(*body, arrangement.of(body.get()).motion);
    }
  }
  for (const auto& [joint, goal] : arrangement.goals()) count_turns(*joint, goal);
  impl_->arrive(model);
}

namespace {

// Applies another center of mass: links, shapes and joints stay at their poses.
void take_masses(ModelRecord& model, ModelRecord& from) {
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    Body& body = *model.bodies[i];
    const Body& other = *from.bodies[i];
    const Pose shift = body.zero.inverse() * other.zero;
    body.at = body.at * shift;
    for (Geom* geom : body.geoms) geom->in_body = shift.inverse() * geom->in_body;
    body.zero = other.zero;
    body.mass = other.mass;
    body.moment = other.moment;
    body.floats = other.floats;
    body.weightless = other.weightless;
  }
  for (std::size_t i = 0; i < model.mechanisms.size(); ++i) {
    model.mechanisms[i]->mass = from.mechanisms[i]->mass;
  }
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    Joint& joint = *model.joints[i];
    const Joint& other = *from.joints[i];
    joint.axes = other.axes;
    joint.axis_in_body = other.axis_in_body;
    joint.anchor_in_first = other.anchor_in_first;
    joint.inertia = other.inertia;
  }
}

}  // namespace

void World::redescribe(ModelId id, const desc::Model& described) {
  ode::prepare_thread();
  ModelRecord& model = *impl_->models.at(id);
  desc::Model bare = described;  // shapes are as they were
  for (desc::Link& link : bare.links) link.collisions.clear();
  std::uint64_t serial = 0;
  const auto built = build_model(bare, impl_->shapes, serial);
  std::map<const Body*, Motion> motions;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const Body& body = *model.bodies[i];
    const Pose shift = body.zero.inverse() * built->bodies[i]->zero;
    motions[&body] = carried(motion_of(body), body.at, body.at * shift);
  }
  impl_->leave(model);
  take_masses(model, *built);
  for (std::size_t i = 0; i < model.link_ids.size(); ++i) {
    LinkRecord& link = impl_->links.at(model.link_ids[i]);
    link.in_body = built->links[i].in_body;
    link.mass = built->links[i].mass;
  }
  for (const auto& mechanism : model.mechanisms) impl_->reinsert(*mechanism);
  for (const auto& body : model.bodies) {
    if (body->ode != nullptr) set_motion(*body, motions.at(body.get()));
  }
  impl_->arrive(model);
}

void World::set(const desc::Physics& settings, const Vec3& gravity) {
  const Nanoseconds step = impl_->settings.step;
  impl_->settings = settings;
  impl_->settings.step = step;
  impl_->gravity = gravity;
  impl_->contacts.set(impl_->settings, gravity);
  impl_->give_settings();
  impl_->models.each([&](ModelId, std::unique_ptr<ModelRecord>& model) {
    for (const auto& body : model->bodies) impl_->wake(*body);
  });
}

}  // namespace angen::physics

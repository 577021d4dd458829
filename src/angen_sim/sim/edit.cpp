#include "sim/edit.h"

#include <algorithm>

#include "core/limits.h"
#include "core/named.h"
#include "core/text.h"
#include "sim/building.h"
#include "sim/entities.h"
#include "sim/joined.h"

namespace angen::sim {

namespace {

void check(const char* what, const Limit& limit, double value, bool positive = false) {
  const std::string problem = limit_problem(limit, value, positive);
  if (problem.empty()) return;
  throw Error(std::string("the ") + what + " is " + number_text(value) + "; " + problem);
}

void check(const char* what, const Limit& limit, const Vec3& values) {
  for (int i = 0; i < 3; ++i) check(what, limit, values[i]);
}

void check(const PushTime& time) {
  if (time.start < 0 || time.start > from_seconds(limits::kTime.most) ||
      time.duration > from_seconds(limits::kTime.most)) {
    throw Error("the time is beyond " + number_text(limits::kTime.most) + " s");
  }
}

/// The motion of a StateIn, in the world.
Motion in_world(const Building& building, const StateIn& state) {
  const std::string problem = pose_problem(state.pose);
  if (!problem.empty()) throw Error(problem);
  check("linear velocity", limits::kSpeed, state.linear);
  check("angular velocity", limits::kTurnRate, state.angular);
  const Pose frame = motion_of(building, state.frame).pose;
  return {frame * state.pose, frame.rotation * state.linear, frame.rotation * state.angular};
}

/// All links of a model move as one rigid body about the origin of `motion`.
void set_motion(Building& building, const LiveModel& live, const std::vector<std::uint32_t>& links,
                const Motion& motion) {
  for (const std::uint32_t link : links) {
    const physics::LinkId id = live.parts.links[link];
    const Vec3 arm = building.engines().physics.pose(id).position - motion.pose.position;
    building.engines().physics.set_velocity(id, motion.linear + motion.angular.cross(arm),
                                            motion.angular);
  }
}

std::vector<std::uint32_t> all_links(const LiveModel& live) {
  std::vector<std::uint32_t> links(live.parts.links.size());
  for (std::uint32_t i = 0; i < links.size(); ++i) links[i] = i;
  return links;
}

/// The links whose bodies joints join to this one's.
std::vector<std::uint32_t> joined_links(const LiveModel& live, std::uint32_t link) {
  const desc::Model& model = *live.desc;
  const auto joined = joined_to({model.links[link].name}, model, true,
                                [](const desc::Joint& j) { return j.parent != "world"; });
  std::vector<std::uint32_t> links;
  for (std::uint32_t i = 0; i < model.links.size(); ++i) {
    if (joined.count(model.links[i].name) != 0) links.push_back(i);
  }
  return links;
}

class Apply {
 public:
  Apply(Building& building, Nanoseconds now)
      : building_(building), physics_(building.engines().physics), now_(now) {}

  void operator()(const SetModelState& edit) {
    const Entity entity = find_model(edit.model);
    LiveModel& live = *entity.model;
    const Motion to = in_world(building_, edit.state);
    const Pose from = motion_of(building_, entity).pose;
    physics_.move(live.parts.body, to.pose * from.inverse());
    set_motion(building_, live, all_links(live), to);
    building_.note_placed(live);
  }

  void operator()(const SetLinkState& edit) {
    const Entity entity = find_link(building_, edit.link);
    LiveModel& live = *entity.model;
    const Motion to = in_world(building_, edit.state);
    const Pose by = to.pose * motion_of(building_, entity).pose.inverse();
    if (live.desc->is_static) {
      physics_.move(live.parts.body, by);
    } else {
      physics_.move(live.parts.links[entity.link], by);
      set_motion(building_, live, joined_links(live, entity.link), to);
    }
    building_.note_placed(live);
  }

  void operator()(const SetJoints& edit) {
    if (edit.joints.size() != edit.positions.size()) {
      throw Error(std::to_string(edit.joints.size()) + " joints and " +
                  std::to_string(edit.positions.size()) + " positions");
    }
    LiveModel& live = *find_model(edit.model).model;
    std::vector<std::optional<double>> positions(live.parts.joints.size());
    for (std::size_t i = 0; i < edit.joints.size(); ++i) {
      check("position", limits::kAngle, edit.positions[i]);
      const std::string name = edit.joints[i].find("::") == std::string::npos
                                   ? live.desc->name + "::" + edit.joints[i]
                                   : edit.joints[i];
      const FoundJoint joint = find_joint(building_, name);
      if (joint.model != &live) throw Error("joint '" + printable(name) + "' is of another model");
      positions[joint.joint] = edit.positions[i];
    }
    physics_.arrange(live.parts.body, positions);
    building_.note_placed(live);
  }

  void operator()(const PushLink& edit) {
    const Entity entity = find_link(building_, edit.link);
    check(edit.time);
    check("force", limits::kForce, edit.force);
    check("torque", limits::kTorque, edit.torque);
    check("point", limits::kPosition, edit.point);
    const LiveModel& live = *entity.model;
    if (physics_.mass(live.parts.links[entity.link]) == 0.0) throw Error("the link is static");
    Vec3 force = edit.force;
    Vec3 torque = edit.torque + edit.point.cross(edit.force);
    if (!edit.frame.empty()) {
      const Pose frame = motion_of(building_, edit.frame).pose;
      const Vec3 arm = frame.position - motion_of(building_, entity).pose.position;
      force = frame.rotation * edit.force;
      torque = frame.rotation * torque + arm.cross(force);
    }
    check("torque with the force's arm", limits::kTorque, torque);
    if (edit.time.duration != 0) {
      building_.pushes().add(live, entity.link, force, torque, from_now(edit.time));
    }
  }

  void operator()(const PushJoint& edit) {
    const FoundJoint joint = find_joint(building_, edit.joint);
    check(edit.time);
    check("effort", limits::kForce, edit.effort);
    if (joint.model->desc->joints[joint.joint].axes.empty()) throw Error("the joint has no axis");
    if (edit.time.duration != 0) {
      building_.pushes().add(*joint.model, joint.joint, edit.effort, from_now(edit.time));
    }
  }

  void operator()(const ClearPushes& edit) {
    const Entity model = find_entity(building_, edit.of.substr(0, edit.of.find("::")));
    const desc::Model& described = *model.model->desc;
    const std::string name = edit.of.substr(std::min(edit.of.size(), described.name.size() + 2));
    bool found = false;
    if (const auto link = index_in(described.links, name)) {
      building_.pushes().clear_link(*model.model, *link);
      found = true;
    }
    if (const auto joint = index_in(described.joints, name)) {
      building_.pushes().clear_joint(*model.model, *joint);
      found = true;
    }
    if (!found) throw Error("'" + printable(edit.of) + "' is neither a link nor a joint");
  }

  void operator()(const SetLinkProperties& edit) {
    const Entity entity = find_link(building_, edit.link);
    const desc::Inertial& inertial = edit.inertial;
    for (const std::string& problem :
         {pose_problem(inertial.pose), inertia_problem(inertial.mass, inertial.moment)}) {
      if (!problem.empty()) throw Error(problem);
    }
    desc::Model model = *entity.model->desc;
    model.links[entity.link].inertial = inertial;
    model.links[entity.link].gravity = edit.gravity;
    building_.redescribe(*entity.model, std::move(model));
  }

  void operator()(const SetJointProperties& edit) {
    const FoundJoint found = find_joint(building_, edit.joint);
    desc::Model model = *found.model->desc;
    std::vector<desc::JointAxis>& axes = model.joints[found.joint].axes;
    const auto set = [&](const char* what, const std::vector<double>& values, auto member) {
      if (values.size() > axes.size()) {
        throw Error("the joint has " + std::to_string(axes.size()) + " axes, " + what + " has " +
                    std::to_string(values.size()) + " numbers");
      }
      for (std::size_t i = 0; i < values.size(); ++i) {
        check(what, limits::kNoLimit, values[i]);
        axes[i].*member = values[i];
      }
    };
    set("damping", edit.damping, &desc::JointAxis::damping);
    set("hiStop", edit.upper, &desc::JointAxis::upper);
    set("loStop", edit.lower, &desc::JointAxis::lower);
    check("motor's velocity", limits::kTurnRate, edit.motor_velocity);
    if (edit.motor_force) check("motor's force", limits::kNoLimit, *edit.motor_force);
    for (desc::JointAxis& axis : axes) {
      if (axis.damping < 0.0) throw Error("the damping is negative");
      if (axis.lower > axis.upper) {
        throw Error("the lower limit " + number_text(axis.lower) + " is above the upper limit " +
                    number_text(axis.upper));
      }
      if (axis.lower > limits::kPosition.most || axis.upper < -limits::kPosition.most) {
        throw Error("the stops " + number_text(axis.lower) + " and " + number_text(axis.upper) +
                    " leave no position within " + number_text(limits::kPosition.most));
      }
      axis.initial_position = std::clamp(axis.initial_position, axis.lower, axis.upper);
    }
    const bool described = !(edit.damping.empty() && edit.upper.empty() && edit.lower.empty());
    if (described) building_.redescribe(*found.model, std::move(model));
    if (!edit.motor_force) return;
    physics_.set_motor(found.model->parts.joints[found.joint], edit.motor_velocity,
                       *edit.motor_force);
  }

  void operator()(const SetPhysics& edit) {
    check("gravity", limits::kGravity, edit.gravity);
    const desc::Physics& physics = edit.physics;
    if (physics.iterations < 1 || physics.iterations > kMaxIterations) {
      throw Error("the number of iterations is " + std::to_string(physics.iterations) +
                  "; it must be 1 to " + std::to_string(kMaxIterations));
    }
    check_share("erp", physics.erp);
    check_share("cfm", physics.cfm);
    check("contact_surface_layer", limits::kLength, physics.contact_surface_layer);
    check("contact_max_correcting_vel", limits::kNoLimit, physics.contact_max_correcting_vel);
    if (physics.contact_surface_layer < 0.0 || physics.contact_max_correcting_vel < 0.0) {
      throw Error("contact_surface_layer and contact_max_correcting_vel must not be negative");
    }
    building_.set_physics(physics, edit.gravity);
  }

  void operator()(const SetLight& edit) {
    desc::Light light = building_.light(edit.light);
    const std::string problem = pose_problem(edit.pose);
    if (!problem.empty()) throw Error(problem);
    for (int i = 0; i < 3; ++i) {
      check("diffuse color", limits::kColor, static_cast<double>(edit.diffuse[i]));
      if (edit.diffuse[i] < 0.0F) throw Error("the diffuse color is negative");
    }
    check("direction", limits::kDirection, edit.direction);
    light.diffuse = edit.diffuse;
    light.cast_shadows = edit.cast_shadows;
    if (edit.direction.norm() > 1e-9) light.direction = edit.direction.normalized();
    light.pose = edit.pose;
    building_.set_light(edit.light, light);
  }

  void operator()(const AddLight& edit) { building_.add_light(edit.light, edit.sdf, now_); }
  void operator()(const DeleteLight& edit) { building_.erase_light(edit.light); }

 private:
  static constexpr int kMaxIterations = 10'000;

  Entity find_model(const std::string& name) const {
    const Entity entity = find_entity(building_, name);
    if (!entity.is_model) throw Error("'" + printable(name) + "' is not a model");
    return entity;
  }

  static void check_share(const char* what, double value) {
    if (!(value >= 0.0 && value <= 1.0)) {
      throw Error(std::string(what) + " is " + number_text(value) + "; it must be 0 to 1");
    }
  }

  PushTime from_now(PushTime time) const {
    time.start = std::max(time.start, now_);
    return time;
  }

  Building& building_;
  physics::World& physics_;
  Nanoseconds now_;
};

}  // namespace

void apply(const Edit& edit, Building& building, Nanoseconds now) {
  std::visit(Apply(building, now), edit);
}

}  // namespace angen::sim

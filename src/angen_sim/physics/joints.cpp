#include "physics/joints.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace angen::physics {

namespace {

using Type = desc::Joint::Type;

constexpr double kStopCfm = 1e-9;
constexpr double kStiffest = 0.25;  // (rad/step)^2, of a spring that is taken explicitly

dBodyID ode_of(const Body* body) { return body->ode.get(); }

void set_param(const Joint& joint, int parameter, double value) {
  switch (joint.type) {
    case Type::kRevolute:
      return dJointSetHingeParam(joint.main.get(), parameter, value);
    case Type::kPrismatic:
      return dJointSetSliderParam(joint.main.get(), parameter, value);
    case Type::kUniversal:
      return dJointSetUniversalParam(joint.main.get(), parameter, value);
    case Type::kScrew:  // by its way: ODE's angles end at half a turn
      return dJointSetPistonParam(joint.main.get(), parameter, value);
    default:
      return;
  }
}

void set_motor_param(const Joint& joint, int parameter, double value) {
  switch (joint.type) {
    case Type::kPrismatic:
      return dJointSetLMotorParam(joint.motor.get(), parameter, value);
    case Type::kUniversal:
      return dJointSetUniversalParam(joint.main.get(), parameter, value);
    default:
      return dJointSetAMotorParam(joint.motor.get(), parameter, value);
  }
}

void set_range(const Joint& joint, double lower, double upper, int group) {
  if (joint.type == Type::kScrew) {
    lower *= joint.lead;
    upper *= joint.lead;
    if (lower > upper) std::swap(lower, upper);
  }
  set_param(joint, dParamLoStop + group, lower);
  set_param(joint, dParamHiStop + group, upper);
  // Once more: ODE may have rejected a stop beyond the other one's old value.
  set_param(joint, dParamLoStop + group, lower);
}

void set_stops(const Joint& joint, const Axis& axis, int group) {
  set_range(joint, axis.lower, axis.upper, group);
  set_param(joint, dParamBounce + group, 0.0);
  set_param(joint, dParamStopERP + group, kStopErp);
  set_param(joint, dParamStopCFM + group, kStopCfm);
}

ode::JointHandle make_main(dWorldID world, Type type) {
  switch (type) {
    case Type::kRevolute:
      return ode::JointHandle(dJointCreateHinge(world, nullptr));
    case Type::kPrismatic:
      return ode::JointHandle(dJointCreateSlider(world, nullptr));
    case Type::kBall:
      return ode::JointHandle(dJointCreateBall(world, nullptr));
    case Type::kScrew:
      return ode::JointHandle(dJointCreatePiston(world, nullptr));
    default:
      return ode::JointHandle(dJointCreateUniversal(world, nullptr));
  }
}

// The side of the joint that has the smaller inertia about, or mass along, its axis; a screw has
// both.
double least_inertia(const Joint& joint, const Vec3& axis) {
  const auto of_body = [&](const Body& body, bool pivots) {
    if (joint.type == Type::kPrismatic) return body.mass;
    const Vec3 turned = body.zero.rotation.conjugate() * axis;
    const Vec3 arm = axis.cross(joint.anchor - body.zero.position);
    return turned.dot(body.moment * turned) + body.mass * joint.lead * joint.lead +
           (pivots ? body.mass * arm.squaredNorm() : 0.0);
  };
  if (!joint.second->dynamic()) return of_body(*joint.first, true);
  const double one = of_body(*joint.first, false);
  const double two = of_body(*joint.second, false);
  return one * two / (one + two);
}

// A damper is a motor of speed 0 whose row gives way by 1/d: implicit, so stable for any d.
void set_damping(const Joint& joint) {
  const double damping = joint.axes[0].damping;
  if (damping <= 0.0) return;
  const int group = dParamGroup2 - dParamGroup1;
  set_motor_param(joint, dParamVel + group, 0.0);
  set_motor_param(joint, dParamFMax + group, dInfinity);
  set_motor_param(joint, dParamCFM + group, 1.0 / damping);
}

// Axes of a universal joint turn in its own two rows: SDF's first axis is fixed to the parent.
int universal_group(const Joint& joint, std::size_t axis) {
  const bool on_second = (axis == 0) != joint.flipped;
  return on_second ? dParamGroup2 - dParamGroup1 : 0;
}

void make_universal_rows(Joint& joint) {
  for (std::size_t i = 0; i < joint.axes.size(); ++i) {
    const int group = universal_group(joint, i);
    const Axis& axis = joint.axes[i];
    set_stops(joint, axis, group);
    if (axis.friction > 0.0) {
      set_param(joint, dParamFMax + group, axis.friction);
    } else if (axis.damping > 0.0) {
      set_param(joint, dParamFMax + group, dInfinity);
      set_param(joint, dParamCFM + group, 1.0 / axis.damping);
    }
  }
}

// A direction parallel neither to the second axis that a universal joint has nor to the one it will
// get: ODE complains about parallel axes even for the moment between two calls.
Vec3 apart_from(dJointID universal, const Vec3& next) {
  dVector3 now;
  dJointGetUniversalAxis2(universal, now);
  const Vec3 across = ode::vec(now).cross(next);
  return across.norm() > 1e-3 ? across : next.unitOrthogonal();
}

double read_angle(const Joint& joint) {
  if (joint.type == Type::kRevolute) return dJointGetHingeAngle(joint.main.get());
  if (joint.type == Type::kScrew) return dJointGetPistonAngle(joint.main.get());
  return joint.flipped ? dJointGetUniversalAngle1(joint.main.get())
                       : dJointGetUniversalAngle2(joint.main.get());
}

// The body that the first axis is fixed to.
const Body& axis_body(const Joint& joint) {
  return joint.type == Type::kUniversal && !joint.flipped ? *joint.second : *joint.first;
}

void push_freely(const Joint& joint, double force) {
  const Vec3 push = force * world_axis(joint);
  dBodyID first = joint.first->ode.get();
  dBodyID second = joint.second->ode.get();
  if (joint.type == Type::kPrismatic) {
    const Vec3& point = joint.first->at.position;
    dBodyAddForce(first, push.x(), push.y(), push.z());
    if (second != nullptr) {
      dBodyAddForceAtPos(second, -push.x(), -push.y(), -push.z(), point.x(), point.y(), point.z());
    }
    return;
  }
  dBodyAddTorque(first, push.x(), push.y(), push.z());
  if (second != nullptr) dBodyAddTorque(second, -push.x(), -push.y(), -push.z());
}

// The displacement by a motion `by` (rad, m) about or along this axis through the anchor.
Pose moved_along(const Joint& joint, const Vec3& axis, const Vec3& anchor, double by) {
  Pose moved;
  if (joint.type == Type::kPrismatic) {
    moved.position = by * axis;
    return moved;
  }
  moved.rotation = Eigen::AngleAxisd(by, axis);
  moved.position = anchor - moved.rotation * anchor + joint.lead * by * axis;
  return moved;
}

bool turns(const Joint& joint) {
  return joint.type != Type::kPrismatic && joint.type != Type::kBall;
}

}  // namespace

Vec3 world_axis(const Joint& joint) { return axis_body(joint).at.rotation * joint.axis_in_body; }

void correct_positions(const Joint& joint, bool on) {
  const double erp = on ? kStopErp : 0.0;
  set_param(joint, dParamStopERP, erp);
  if (joint.axes.size() > 1) set_param(joint, dParamStopERP + dParamGroup2 - dParamGroup1, erp);
  // Axes of their own; others have the world's.
  if (joint.type == Type::kBall) {
    dJointSetBallParam(joint.main.get(), dParamERP, on ? kJointErp : 0.0);
  }
  if (joint.thread == nullptr) return;
  dJointSetDBallParam(joint.thread.get(), dParamERP, on ? kJointErp : 0.0);
}

void measure_joint(Joint& joint) {
  joint.anchor_in_first = joint.first->zero.inverse() * joint.anchor;
  if (joint.type == Type::kBall) return;
  joint.axis_in_body = axis_body(joint).zero.rotation.conjugate() * joint.axes[0].in_model;
  joint.inertia = least_inertia(joint, joint.axes[0].in_model);
}

void create_joint(dWorldID world, Joint& joint) {
  joint.main = make_main(world, joint.type);
  dJointAttach(joint.main.get(), ode_of(joint.first), ode_of(joint.second));
  dJointSetFeedback(joint.main.get(), &joint.main_feedback);
  if (joint.type == Type::kScrew) {
    joint.thread.reset(dJointCreateDBall(world, nullptr));
    dJointAttach(joint.thread.get(), ode_of(joint.first), ode_of(joint.second));
    dJointSetFeedback(joint.thread.get(), &joint.thread_feedback);
  }
  if (joint.type == Type::kRevolute || joint.type == Type::kScrew) {
    joint.motor.reset(dJointCreateAMotor(world, nullptr));
    dJointSetAMotorNumAxes(joint.motor.get(), 2);
  } else if (joint.type == Type::kPrismatic) {
    joint.motor.reset(dJointCreateLMotor(world, nullptr));
    dJointSetLMotorNumAxes(joint.motor.get(), 2);
  } else if (joint.type == Type::kUniversal) {
    make_universal_rows(joint);
    return;
  } else {
    return;
  }
  dJointAttach(joint.motor.get(), ode_of(joint.first), ode_of(joint.second));
  dJointSetFeedback(joint.motor.get(), &joint.motor_feedback);
  set_stops(joint, joint.axes[0], 0);
  set_damping(joint);
  apply_latch(joint);
}

void anchor_joint(const Joint& joint, const Pose& model) {
  const Vec3 anchor = model * joint.anchor;
  dJointID main = joint.main.get();
  if (joint.type == Type::kBall) {
    dJointSetBallAnchor(main, anchor.x(), anchor.y(), anchor.z());
    return;
  }
  const Vec3 axis = model.rotation * joint.axes[0].in_model;
  if (joint.type == Type::kUniversal) {
    const Vec3 other = model.rotation * joint.axes[1].in_model;
    const Vec3& one = joint.flipped ? axis : other;
    const Vec3& two = joint.flipped ? other : axis;
    dJointSetUniversalAnchor(main, anchor.x(), anchor.y(), anchor.z());
    const Vec3 aside = apart_from(main, two);
    dJointSetUniversalAxis1(main, aside.x(), aside.y(), aside.z());
    dJointSetUniversalAxis2(main, two.x(), two.y(), two.z());
    dJointSetUniversalAxis1(main, one.x(), one.y(), one.z());
    return;
  }
  dJointID motor = joint.motor.get();
  if (turns(joint)) {
    const bool hinge = joint.type == Type::kRevolute;
    (hinge ? dJointSetHingeAnchor : dJointSetPistonAnchor)(main, anchor.x(), anchor.y(),
                                                           anchor.z());
    (hinge ? dJointSetHingeAxis : dJointSetPistonAxis)(main, axis.x(), axis.y(), axis.z());
    for (int row = 0; row < 2; ++row) {
      dJointSetAMotorAxis(motor, row, 1, axis.x(), axis.y(), axis.z());
    }
  } else {
    dJointSetSliderAxis(main, axis.x(), axis.y(), axis.z());
    for (int row = 0; row < 2; ++row) {
      dJointSetLMotorAxis(motor, row, 1, axis.x(), axis.y(), axis.z());
    }
  }
}

void reset_joint(Joint& joint) {
  joint.effort = 0.0;
  joint.turns = 0;
  joint.position = 0.0;
  if (joint.first == nullptr || joint.type == Type::kBall) return;
  const bool turns_on = joint.type == Type::kRevolute || joint.type == Type::kScrew;
  count_turns(joint, turns_on ? joint.axes[0].initial : 0.0);
}

void count_turns(Joint& joint, double position) {
  if (turns(joint)) {
    joint.raw_angle = read_angle(joint);
    joint.turns = static_cast<int>(std::lround((position - joint.raw_angle) / (2.0 * M_PI)));
    joint.position = joint.raw_angle + 2.0 * M_PI * joint.turns;
  } else {
    joint.position = dJointGetSliderPosition(joint.main.get());
  }
  if (!joint.latched) return;
  joint.latch_at = ode_position(joint);
  apply_latch(joint);
}

Pose joint_step(const Joint& joint, double by) {
  return moved_along(joint, world_axis(joint), joint.first->at * joint.anchor_in_first, by);
}

void apply_motor(const Joint& joint) {
  const bool on = joint.motor_force > 0.0;
  const Bounds speeds = on ? velocity_bounds(joint) : Bounds{};
  const double velocity = std::clamp(on ? joint.motor_velocity : 0.0, speeds.low, speeds.high);
  const double force = on ? joint.motor_force : joint.axes[0].friction;
  const int group = joint.type == Type::kUniversal ? universal_group(joint, 0) : 0;
  set_motor_param(joint, dParamVel + group, velocity);
  set_motor_param(joint, dParamFMax + group, force);
}

// Two stops in one place hold against any force.
void apply_latch(const Joint& joint) {
  const Axis& axis = joint.axes[0];
  const bool stuck = joint.latched && !joint.latch_broken;
  set_range(joint, stuck ? joint.latch_at : axis.lower, stuck ? joint.latch_at : axis.upper, 0);
  apply_motor(joint);
}

double ode_position(const Joint& joint) {
  return turns(joint) ? read_angle(joint) : dJointGetSliderPosition(joint.main.get());
}

void update_joint(Joint& joint, double h) {
  joint.pushed = std::exchange(joint.pushes, 0.0);
  if (joint.first == nullptr || joint.type == Type::kBall) return;
  const Pose& at = joint.first->at;
  const Vec3 axis = world_axis(joint);
  const dJointFeedback& main = joint.main_feedback;
  const dJointFeedback& motor = joint.motor_feedback;
  if (turns(joint)) {
    const double angle = read_angle(joint);
    if (angle - joint.raw_angle > M_PI) --joint.turns;
    if (angle - joint.raw_angle < -M_PI) ++joint.turns;
    joint.raw_angle = angle;
    joint.position = angle + 2.0 * M_PI * joint.turns;
    const Vec3 arm = -(at.rotation * joint.anchor_in_first);
    const Vec3 torque = ode::vec(main.t1) + arm.cross(ode::vec(main.f1)) + ode::vec(motor.t1);
    const double at_stop = joint.lead * axis.dot(ode::vec(main.f1));  // a screw's force at its stop
    joint.effort = axis.dot(torque) + at_stop + joint.spring_effort;
  } else {
    joint.position = dJointGetSliderPosition(joint.main.get());
    joint.effort = axis.dot(ode::vec(main.f1) + ode::vec(motor.f1)) + joint.spring_effort;
  }
  watch_latch(joint, h);
}

Wrench joint_wrench(const Joint& joint) {
  if (joint.first == nullptr) return {};
  const dJointFeedback& main = joint.main_feedback;
  const dJointFeedback& motor = joint.motor_feedback;
  Wrench on_first;  // ODE's torques are about its center
  const dJointFeedback& thread = joint.thread_feedback;
  on_first.force = ode::vec(main.f1) + ode::vec(motor.f1) + ode::vec(thread.f1);
  on_first.torque = ode::vec(main.t1) + ode::vec(motor.t1) + ode::vec(thread.t1);
  if (joint.type != Type::kBall) {
    const Vec3 along = (joint.spring_effort + joint.pushed) * world_axis(joint);
    (joint.type == Type::kPrismatic ? on_first.force : on_first.torque) += along;
  }
  const Vec3 arm = -(joint.first->at.rotation * joint.anchor_in_first);
  on_first.torque += arm.cross(on_first.force);
  const double sign = joint.flipped ? 1.0 : -1.0;
  return {sign * on_first.force, sign * on_first.torque};
}

double joint_velocity(const Joint& joint) {
  if (joint.first == nullptr || joint.type == Type::kBall) return 0.0;
  const Body& first = *joint.first;
  const Body& second = *joint.second;
  const Vec3 axis = world_axis(joint);
  if (turns(joint)) return axis.dot(first.spin() - second.spin());
  const Vec3 arm = first.at.position - second.at.position;
  return axis.dot(first.velocity() - second.velocity() - second.spin().cross(arm));
}

void push_joint(Joint& joint, double force) {
  if (joint.first == nullptr) return;  // nothing that moves
  const Bounds efforts = effort_bounds(joint, joint_velocity(joint));
  const double pushed = std::clamp(force, efforts.low, efforts.high);
  joint.pushes += pushed;
  push_freely(joint, pushed);
}

// At the position where the step starts: with the solver's semi-implicit steps that keeps the
// energy, up to half a radian a step. A stiffer spring is implicit, with the damper: stable,
// but it loses energy.
void apply_spring(Joint& joint, double h) {
  const Axis& axis = joint.axes[0];
  const double away = joint.position - axis.slack_at;
  const bool stiff = axis.stiffness * h * h > kStiffest * joint.inertia;
  joint.spring_effort = stiff ? 0.0 : -axis.stiffness * away;
  if (!stiff) return push_freely(joint, joint.spring_effort);
  const double yields = 1.0 / (h * axis.stiffness + axis.damping);
  const int group = dParamGroup2 - dParamGroup1;
  set_motor_param(joint, dParamVel + group, -axis.stiffness * away * yields);
  set_motor_param(joint, dParamFMax + group, dInfinity);
  set_motor_param(joint, dParamCFM + group, yields);
}

Pose joint_displacement(const Joint& joint) {
  if (joint.first == nullptr || joint.axes.empty()) return {};
  const bool is_one = joint.type == Type::kRevolute || joint.type == Type::kScrew;
  if (!is_one && joint.type != Type::kPrismatic) return {};
  return moved_along(joint, joint.axes[0].in_model, joint.anchor, joint.axes[0].initial);
}

namespace {

constexpr double kLatchTime = 0.1;  // s
constexpr double kBlow = 10.0;      // times its force: a blow shorter than 10 ms does not break it
constexpr double kLatchSpeed = 0.002;  // rad/s or m/s
constexpr double kLatchAgain = 0.9;    // share of its force

}  // namespace

void watch_latch(Joint& joint, double h) {
  if (!joint.latched || !std::isfinite(joint.latch_force)) return;
  const double most = kBlow * joint.latch_force;
  const double borne = std::clamp(joint.effort - joint.spring_effort, -most, most);
  joint.latch_strain += (borne - joint.latch_strain) * h / (h + kLatchTime);
  const double strain = std::abs(joint.latch_strain);
  const bool at_rest = std::abs(joint_velocity(joint)) < kLatchSpeed;
  const bool breaks = !joint.latch_broken && strain >= joint.latch_force;
  const bool catches = joint.latch_broken && at_rest && strain < kLatchAgain * joint.latch_force;
  if (!breaks && !catches) return;
  joint.latch_broken = breaks;
  joint.latch_at = ode_position(joint);
  apply_latch(joint);
}

Bounds velocity_bounds(const Joint& joint) {
  const Axis& axis = joint.axes[0];
  const double most = axis.velocity >= 0.0 ? axis.velocity : dInfinity;
  if (!axis.safety || axis.safety->k_position == 0.0) return {-most, most};
  const desc::JointSafety& safety = *axis.safety;
  const double k = safety.k_position;
  return {std::clamp(-k * (joint.position - safety.soft_lower), -most, most),
          std::clamp(-k * (joint.position - safety.soft_upper), -most, most)};
}

Bounds effort_bounds(const Joint& joint, double velocity) {
  const Axis& axis = joint.axes[0];
  const double most = axis.effort >= 0.0 ? axis.effort : dInfinity;
  const Bounds speeds = velocity_bounds(joint);
  if (axis.safety && axis.safety->k_velocity > 0.0) {
    const double k = axis.safety->k_velocity;
    return {std::clamp(-k * (velocity - speeds.low), -most, most),
            std::clamp(-k * (velocity - speeds.high), -most, most)};
  }
  return {velocity < speeds.low ? 0.0 : -most, velocity > speeds.high ? 0.0 : most};
}

namespace {

constexpr double kNarrowest = 0.01;  // m, radius of a thread
constexpr double kWidest = 1.0;
constexpr double kFar = 0.5;  // m, that a thread gives back in a step at most

}  // namespace

// A thread is a slant in which the first body slides, at some distance from the axis: one row of a
// force that holds both ways. The others of the screw's forces are those of its piston.
void aim_thread(const Joint& joint) {
  const Body& second = *joint.second;
  const Vec3 axis = world_axis(joint);
  const Vec3 middle = joint.first->at * joint.anchor_in_first;
  const Vec3 start = second.at * (second.zero.inverse() * joint.anchor);
  const double radius = std::clamp(std::abs(joint.lead), kNarrowest, kWidest);
  const Vec3 outward = axis.unitOrthogonal();
  const double norm = std::hypot(radius, joint.lead);
  const Vec3 normal = (radius * axis - joint.lead * axis.cross(outward)) / norm;
  const double ahead = axis.dot(middle - start) - joint.lead * joint.position;  // m
  const Vec3 at = middle + radius * outward;
  const Vec3 other = at - normal;
  dJointSetDBallAnchor1(joint.thread.get(), at.x(), at.y(), at.z());
  dJointSetDBallAnchor2(joint.thread.get(), other.x(), other.y(), other.z());
  dJointSetDBallDistance(joint.thread.get(), 1.0 - std::clamp(radius / norm * ahead, -kFar, kFar));
}

}  // namespace angen::physics

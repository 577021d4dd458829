#pragma once

#include "physics/model.h"

namespace angen::physics {

/// Bodies move straight on in a step, and so part at a joint about which they turn. All of that is
/// corrected in the next step. A later correction, of a velocity that has turned meanwhile,
/// costs energy: with 0.2 a double pendulum loses some percent a minute.
constexpr double kJointErp = 1.0;
/// Stops correct a fifth of the overshoot in each step: a door comes to rest at its stop.
constexpr double kStopErp = 0.2;

/// Finds axis and anchor in the frames of the joint's bodies, of which one is dynamic.
void measure_joint(Joint& joint);

/// Makes ODE's objects for a joint whose dynamic bodies ODE has.
void create_joint(dWorldID world, Joint& joint);

/// Gives ODE anchor, axes and zero position; the bodies' poses must be those of all joints at 0.
void anchor_joint(const Joint& joint, const Pose& model);

/// Reads the angle again after its bodies were moved, near `initial` for joints that turn
/// on.
void reset_joint(Joint& joint);

struct Bounds {
  double low = 0.0;
  double high = 0.0;
};

/// Bounds of the first axis' speed at its position by limits and <safety_controller>, rad/s or
/// m/s.
Bounds velocity_bounds(const Joint& joint);

/// Bounds of a force that is added at that speed, N m or N.
Bounds effort_bounds(const Joint& joint, double velocity);

/// Sets motor, or dry friction where there is none, of a joint that ODE has.
void apply_motor(const Joint& joint);

/// Whether its stops, a ball joint and the thread of a screw correct positions.
void correct_positions(const Joint& joint, bool on);

/// Sets stops and motor of a latched joint that ODE has, or gives it its own again.
void apply_latch(const Joint& joint);
/// Breaks a latch whose force, averaged over 0.1 s, is too much; peaks count as ten times what
/// breaks it at most. A broken one catches the joint at its position once that force has ended.
void watch_latch(Joint& joint, double h);

/// The first axis in the world.
Vec3 world_axis(const Joint& joint);

/// Gives the thread of a screw the direction and the error of its next step.
void aim_thread(const Joint& joint);

/// The position that ODE measures, rad in [-pi, pi] or m.
double ode_position(const Joint& joint);

/// Applies the spring of the first axis for a step of h seconds.
void apply_spring(Joint& joint, double h);

/// Reads position and effort after a step.
void update_joint(Joint& joint, double h);

/// Force and torque of the child on the parent in the last step.
Wrench joint_wrench(const Joint& joint);

/// Speed of the first axis, rad/s or m/s.
double joint_velocity(const Joint& joint);

/// Adds a force or torque for the next step, within effort_bounds(). ODE must have the joint's
/// bodies.
void push_joint(Joint& joint, double force);

/// The displacement of the first body in the world by a motion `by` along or about the axis (rad,
/// m).
Pose joint_step(const Joint& joint, double by);

/// After its bodies were put somewhere: the position is the one near `position`, whole turns
/// counted.
void count_turns(Joint& joint, double position);

/// The displacement that `position` of the first axis gives the child, in the model's frame at 0.
Pose joint_displacement(const Joint& joint);

}  // namespace angen::physics

#pragma once

#include "physics/model.h"

namespace angen::physics {

/// Makes ODE's objects for a joint whose bodies are known; a joint without a dynamic body stays
/// empty.
void create_joint(dWorldID world, Joint& joint);

/// Tells ODE anchor, axes and zero position; the bodies must stand where all joints are at 0.
void anchor_joint(Joint& joint, const Pose& model);

/// Reads the angle anew after its bodies were put somewhere, near `initial` for joints that turn
/// on.
void reset_joint(Joint& joint);

/// Sets motor, or dry friction where there is none.
void apply_motor(Joint& joint);

/// Reads position and effort after a step.
void update_joint(Joint& joint);

/// Speed of the first axis, rad/s or m/s.
double joint_velocity(const Joint& joint);

/// Adds a force or torque for the next step, within the axis' effort and velocity limits.
void push_joint(Joint& joint, double force);

/// The displacement that `position` of the first axis gives the child, in the model's frame at 0.
Pose joint_displacement(const Joint& joint);

}  // namespace angen::physics

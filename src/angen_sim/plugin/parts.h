#pragma once

#include <cstdint>
#include <limits>

#include "core/pose.h"

namespace angen {

/// Handles that Wiring gives at configuration; indices into the requests of this instance.
struct JointRef {
  int index = -1;
};
struct LinkRef {
  int index = -1;
};
struct LightRef {
  int index = -1;
};
struct ContactRef {
  int index = -1;
};
struct SurfaceRef {
  int index = -1;
};

struct JointView {
  double position = 0.0;  // rad or m
  double velocity = 0.0;
  double effort = 0.0;  // N m or N that joint and motor gave along the axis in the last step
};
struct LinkView {
  Pose pose;  // world
  Vec3 linear_velocity = Vec3::Zero();
  Vec3 angular_velocity = Vec3::Zero();
  bool awake = false;
};
/// Wrench of a joint's child on its parent, in the last step, with motor and with all that is
/// applied to the joint.
struct JointWrench {
  Vec3 force = Vec3::Zero();   // N, world axes
  Vec3 torque = Vec3::Zero();  // N m, world axes, about the joint's anchor
};
/// They grow, the first when shapes come, go or move: while it stays, rays get the same answers.
struct Revisions {
  std::uint64_t shapes = 0;
  std::uint64_t temperatures = 0;  // when one begins to change, or changes at once
};
/// The stops of a joint, and the resistance to its motion.
struct JointLimits {
  double lower = 0.0;
  double upper = 0.0;
  double damping = 0.0;   // N m s/rad or N s/m
  double friction = 0.0;  // N m or N
  double inertia = 0.0;   // kg m^2 about the axis, or kg: of the child and all that is fixed to it
  double effort = std::numeric_limits<double>::infinity();  // N m or N, most that a motor gives
};

}  // namespace angen

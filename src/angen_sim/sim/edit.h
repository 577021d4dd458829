#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/time.h"
#include "desc/world.h"

/// Changes of models from outside: state, forces, properties, lights. Entities have their
/// full names (entities.h); a frame is one of them, or "" for the world.
namespace angen::sim {

/// Rotations have length 1; poses and motions are those of the frame's axes.
struct StateIn {
  std::string frame;
  Pose pose;
  Vec3 linear = Vec3::Zero();   // m/s, of the origin
  Vec3 angular = Vec3::Zero();  // rad/s
};

/// A whole model with its present joint positions; it moves as one rigid body then.
struct SetModelState {
  std::string model;
  StateIn state;
};
/// A link, and all links that are joined to it.
struct SetLinkState {
  std::string link;
  StateIn state;
};
/// Positions of joints of one axis, within their limits; other joints keep theirs.
struct SetJoints {
  std::string model;
  std::vector<std::string> joints;
  std::vector<double> positions;  // rad or m
};

/// From the first tick at or after `start` for `duration`, rounded up to ticks; negative: until it
/// is cleared.
struct PushTime {
  Nanoseconds start = 0;
  Nanoseconds duration = 0;
};
/// A force at a link's center of mass, and a torque, given in the axes that `frame` has now. The
/// force's arm about the link's origin (about its center of mass where there is no frame) adds to
/// the torque.
struct PushLink {
  std::string link;
  std::string frame;
  Vec3 point = Vec3::Zero();  // m, in the frame
  Vec3 force = Vec3::Zero();  // N
  Vec3 torque = Vec3::Zero();
  PushTime time;
};
/// Along or about a joint's first axis.
struct PushJoint {
  std::string joint;
  double effort = 0.0;  // N or N m
  PushTime time;
};
/// Ends all pushes of one link or joint.
struct ClearPushes {
  std::string of;
};

struct SetLinkProperties {
  std::string link;
  desc::Inertial inertial;
  bool gravity = true;
};
/// One number an axis; an empty list changes nothing.
struct SetJointProperties {
  std::string joint;
  std::vector<double> damping;
  std::vector<double> upper;
  std::vector<double> lower;
  std::optional<double> motor_force;  // the first axis': N m or N, 0 frees it
  double motor_velocity = 0.0;
};
/// The step stays as it is.
struct SetPhysics {
  desc::Physics physics;
  Vec3 gravity = Vec3::Zero();
};

struct SetLight {
  std::string light;
  Eigen::Vector3f diffuse = Eigen::Vector3f::Ones();
  bool cast_shadows = true;
  Vec3 direction = Vec3::Zero();  // zero: stays
  Pose pose;                      // in the world
};
/// A light of the world's own.
struct AddLight {
  desc::Light light;
  std::string sdf;  // the text that it was read from
};
struct DeleteLight {
  std::string light;
};

using Edit = std::variant<SetModelState, SetLinkState, SetJoints, PushLink, PushJoint, ClearPushes,
                          SetLinkProperties, SetJointProperties, SetPhysics, SetLight, AddLight,
                          DeleteLight>;

class Building;

/// Throws Error for an edit that is impossible, and changes nothing then.
void apply(const Edit& edit, Building& building, Nanoseconds now);

}  // namespace angen::sim

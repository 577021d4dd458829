#include <algorithm>
#include <cmath>

#include "physics/joints.h"

namespace angen::physics {

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

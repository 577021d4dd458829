#include <algorithm>
#include <cmath>
#include <map>

#include "load/describe.h"
#include "load/values.h"
#include "load/xml.h"

namespace angen::load {

namespace {

constexpr double kFree = 1e16;  // SDF's "no limit"

desc::Joint::Type type_of(sdf::JointType type, const Element& element) {
  switch (type) {
    case sdf::JointType::FIXED:
      return desc::Joint::Type::kFixed;
    case sdf::JointType::REVOLUTE:
    case sdf::JointType::CONTINUOUS:
      return desc::Joint::Type::kRevolute;
    case sdf::JointType::PRISMATIC:
      return desc::Joint::Type::kPrismatic;
    case sdf::JointType::BALL:
      return desc::Joint::Type::kBall;
    case sdf::JointType::UNIVERSAL:
      return desc::Joint::Type::kUniversal;
    default:
      throw Error(element.source, "a joint of an unknown type; write type=\"revolute\"");
  }
}

desc::JointAxis axis_of(const Element& element, const sdf::JointAxis& from, bool free,
                        const Pose& place) {
  desc::JointAxis axis;
  ignition::math::Vector3d xyz;
  const sdf::Errors errors = from.ResolveXyz(xyz, "__model__");
  if (!errors.empty()) throw Error(element.source, errors.front().Message());
  axis.xyz = (place.rotation * to_vec(xyz)).normalized();
  if (!free) {
    axis.lower = std::max(-kFree, from.Lower());
    axis.upper = std::min(kFree, from.Upper());
  }
  axis.effort = std::isfinite(from.Effort()) ? from.Effort() : -1.0;
  axis.velocity = std::isfinite(from.MaxVelocity()) ? from.MaxVelocity() : -1.0;
  axis.damping = from.Damping();
  axis.friction = from.Friction();
  axis.initial_position = child_number(element, "initial_position", 0.0);
  return axis;
}

// A joint may name a frame; what it holds is that frame's link.
std::string end_of(const sdf::Joint& joint, bool parent, const std::string& prefix,
                   const Source& at) {
  std::string link;
  const sdf::Errors errors = parent ? joint.ResolveParentLink(link) : joint.ResolveChildLink(link);
  if (!errors.empty()) throw Error(at, errors.front().Message());
  return link == "world" ? link : prefix + link;
}

}  // namespace

desc::Joint joint_of(const Element& element, const sdf::Joint& from, const std::string& prefix,
                     const Pose& place) {
  desc::Joint joint;
  joint.name = prefix + name_of(element);
  joint.source = element.source;
  joint.type = type_of(from.Type(), element);
  joint.parent = end_of(from, true, prefix, element.source);
  joint.child = end_of(from, false, prefix, element.source);
  joint.anchor = (place * resolve(from.SemanticPose(), "__model__", element.source)).position;
  if (joint.type == desc::Joint::Type::kFixed || joint.type == desc::Joint::Type::kBall) {
    return joint;
  }
  const bool free = from.Type() == sdf::JointType::CONTINUOUS;
  joint.axes.push_back(axis_of(*element.child("axis"), *from.Axis(0), free, place));
  if (joint.type == desc::Joint::Type::kUniversal) {
    joint.axes.push_back(axis_of(*element.child("axis2"), *from.Axis(1), free, place));
  }
  return joint;
}

}  // namespace angen::load

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/text.h"
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

// <angen:safety_controller>, as <axis> has it in SDF.
std::optional<desc::JointSafety> safety_of(const Element& axis, double lower, double upper) {
  const Element* given = axis.child(kSafety);
  if (given == nullptr) return std::nullopt;
  if (given->child("k_velocity") == nullptr) {
    throw Error(given->source,
                "<safety_controller> has no k_velocity; give it one, N m s/rad or "
                "N s/m");
  }
  desc::JointSafety safety;
  safety.soft_lower = child_number(*given, "soft_lower_limit", lower);
  safety.soft_upper = child_number(*given, "soft_upper_limit", upper);
  safety.k_position = child_number(*given, "k_position", 0.0);
  safety.k_velocity = child_number(*given, "k_velocity", 0.0);
  if (safety.soft_lower > safety.soft_upper) {
    throw Error(given->source, "<safety_controller> has its soft_lower_limit " +
                                   number_text(safety.soft_lower) + " above its soft_upper_limit " +
                                   number_text(safety.soft_upper) + "; exchange them");
  }
  return safety;
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
  axis.spring_stiffness = from.SpringStiffness();
  axis.spring_reference = from.SpringReference();
  axis.initial_position = child_number(element, "initial_position", 0.0);
  axis.safety = safety_of(element, axis.lower, axis.upper);
  const bool endless = free || (axis.lower <= -kFree && axis.upper >= kFree);
  if (axis.safety && endless) axis.safety->k_position = 0.0;
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

bool is_hinge(const desc::Joint& joint) { return joint.type == desc::Joint::Type::kRevolute; }

// Hinges about one line, as a door has an upper and a lower one.
bool on_one_line(const desc::Joint& a, const desc::Joint& b) {
  const Vec3& along = a.axes[0].xyz;
  return along.cross(b.axes[0].xyz).norm() < 1e-6 && along.cross(b.anchor - a.anchor).norm() < 1e-6;
}

}  // namespace

void merge_hinges(desc::Model& model, Session& session) {
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const desc::Joint& first = model.joints[i];
    for (std::size_t j = i + 1; j < model.joints.size();) {
      const desc::Joint& other = model.joints[j];
      if (!is_hinge(first) || !is_hinge(other) || first.parent != other.parent ||
          first.child != other.child) {
        ++j;
        continue;
      }
      const std::string both = "joint '" + other.name + "' joins '" + other.parent + "' and '" +
                               other.child + "', as joint '" + first.name + "' does";
      if (on_one_line(first, other)) {
        session.warn(other.source, both + ", about the same line: they are one, of that name");
        model.joints.erase(model.joints.begin() + static_cast<std::ptrdiff_t>(j));
      } else {
        session.warn(other.source, both + ", about another line: neither can turn");
        ++j;
      }
    }
  }
}

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

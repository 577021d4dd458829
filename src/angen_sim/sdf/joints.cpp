#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/text.h"
#include "document/values.h"
#include "document/xml.h"
#include "import/urdf.h"
#include "sdf/describe.h"
#include "sdf/frames.h"

namespace angen::load {

namespace {

constexpr double kFree = 1e16;  // SDF's "no limit"

desc::Joint::Type type_of(const std::string& type) {
  if (type == "revolute" || type == "continuous") return desc::Joint::Type::kRevolute;
  if (type == "prismatic") return desc::Joint::Type::kPrismatic;
  if (type == "ball") return desc::Joint::Type::kBall;
  if (type == "universal") return desc::Joint::Type::kUniversal;
  return desc::Joint::Type::kFixed;
}

// A number of a limit, which may be infinite.
double limit_of(const Element* limit, const std::string& name, double fallback) {
  const Element* child = limit == nullptr ? nullptr : limit->child(name);
  if (child == nullptr) return fallback;
  const Numbers found = numbers_in(child->text);
  return found.values.size() == 1 ? found.values[0] : number_of(*child);
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

desc::JointAxis axis_of(const Element& element, bool free, const std::string& joint,
                        const std::string& scope, Frames& frames) {
  desc::JointAxis axis;
  Vec3 xyz = Vec3::UnitZ();
  const Element* given = element.child("xyz");
  if (given != nullptr) {
    const std::vector<double> v = numbers_of(*given, 3);
    xyz = {v[0], v[1], v[2]};
  }
  const std::string* frame = given == nullptr ? nullptr : given->attribute("expressed_in");
  const Quat& turn = frame == nullptr || frame->empty() ? frames.pose(joint).rotation
                                                        : frames.rotation(*frame, scope, element);
  axis.xyz = (turn * xyz).normalized();
  const Element* limit = element.child("limit");
  if (!free) {
    axis.lower = std::max(-kFree, limit_of(limit, "lower", -kFree));
    axis.upper = std::min(kFree, limit_of(limit, "upper", kFree));
  }
  axis.effort = std::max(-1.0, limit_of(limit, "effort", -1.0));
  axis.velocity = std::max(-1.0, limit_of(limit, "velocity", -1.0));
  if (const Element* dynamics = element.child("dynamics")) {
    axis.damping = child_number(*dynamics, "damping", 0.0);
    axis.friction = child_number(*dynamics, "friction", 0.0);
    axis.spring_stiffness = child_number(*dynamics, "spring_stiffness", 0.0);
    axis.spring_reference = child_number(*dynamics, "spring_reference", 0.0);
  }
  axis.initial_position = child_number(element, "initial_position", 0.0);
  axis.safety = safety_of(element, axis.lower, axis.upper);
  const bool endless = free || (axis.lower <= -kFree && axis.upper >= kFree);
  if (axis.safety && endless) axis.safety->k_position = 0.0;
  return axis;
}

bool is_hinge(const desc::Joint& joint) { return joint.type == desc::Joint::Type::kRevolute; }

// Hinges about one line, as a door has an upper and a lower one.
bool on_one_line(const desc::Joint& a, const desc::Joint& b) {
  const Vec3& along = a.axes[0].xyz;
  return along.cross(b.axes[0].xyz).norm() < 1e-6 && along.cross(b.anchor - a.anchor).norm() < 1e-6;
}

}  // namespace

void merge_hinges(desc::Model& model, Session& session) {
  std::map<std::pair<std::string, std::string>, std::vector<std::size_t>> between;
  std::vector<bool> merged(model.joints.size(), false);
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const desc::Joint& other = model.joints[j];
    if (!is_hinge(other)) continue;
    std::vector<std::size_t>& before = between[{other.parent, other.child}];
    for (const std::size_t i : before) {
      const desc::Joint& first = model.joints[i];
      const std::string both = "joint '" + other.name + "' joins '" + other.parent + "' and '" +
                               other.child + "', as joint '" + first.name + "' does";
      if (on_one_line(first, other)) {
        session.warn(other.source, both + ", about the same line: they are one, of that name");
        merged[j] = true;
        break;
      }
      session.warn(other.source, both + ", about another line: neither can turn");
    }
    if (!merged[j]) before.push_back(j);
  }
  std::size_t kept = 0;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    if (!merged[j] && kept++ != j) model.joints[kept - 1] = std::move(model.joints[j]);
  }
  model.joints.resize(kept);
}

desc::Joint joint_of(const Element& element, const std::string& scope, Frames& frames) {
  desc::Joint joint;
  joint.name = scope + name_of(element);
  joint.source = element.source;
  const std::string& type = *element.attribute("type");
  joint.type = type_of(type);
  joint.parent = frames.link_of(element.child_text("parent"), scope, element);
  joint.child = frames.link_of(element.child_text("child"), scope, element);
  joint.anchor = frames.pose(joint.name).position;
  if (joint.type == desc::Joint::Type::kFixed || joint.type == desc::Joint::Type::kBall) {
    return joint;
  }
  const bool free = type == "continuous";
  joint.axes.push_back(axis_of(*element.child("axis"), free, joint.name, scope, frames));
  if (joint.type == desc::Joint::Type::kUniversal) {
    joint.axes.push_back(axis_of(*element.child("axis2"), free, joint.name, scope, frames));
  }
  return joint;
}

}  // namespace angen::load

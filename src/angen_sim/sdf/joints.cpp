#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>

#include "core/limits.h"
#include "core/text.h"
#include "document/values.h"
#include "document/xml.h"
#include "sdf/describe.h"
#include "sdf/frames.h"

namespace angen::load {

namespace {

constexpr double kFree = 1e16;           // SDF's "no limit"
constexpr double kMostParallel = 0.999;  // cosine between two axes
constexpr double kLeastPitch = 1e-3;     // rad/m; a thread with less does not turn

/// Requires one of the types that check_joint() permits.
desc::Joint::Type type_of(const std::string& type) {
  const auto& known = desc::Joint::kTypes;
  const std::string name = type == "continuous" ? "revolute" : type;
  return static_cast<desc::Joint::Type>(std::find(known, std::end(known), name) - known);
}

// May be infinite, but no joint reaches beyond where positions end.
double limit_of(const Reader& limit, const std::string& key, double fallback) {
  const Element* child = limit.child(key);
  if (child == nullptr) return fallback;
  const Numbers found = numbers_in(child->text);
  const bool number = found.bad.empty() && found.values.size() == 1 && !std::isnan(found.values[0]);
  const double value = number ? found.values[0] : number_of(*child);
  const double most = limits::kPosition.most;
  if (key == "lower" ? value <= most : value >= -most) return value;
  throw Error(child->source,
              "<" + key + "> is " + number_text(value) + "; it must be at " +
                  (key == "lower" ? "most " + number_text(most) : "least " + number_text(-most)));
}

// <angen:safety_controller>, as <axis> has it in SDF.
std::optional<desc::JointSafety> safety_of(const Reader& given, double lower, double upper) {
  if (!given) return std::nullopt;
  const Source& at = given.element().source;
  if (given.child("k_velocity") == nullptr) {
    throw Error(at,
                "<safety_controller> has no k_velocity; give it one, N m s/rad or "
                "N s/m");
  }
  desc::JointSafety safety;
  safety.soft_lower = given.number("soft_lower_limit", lower, Range::any(limits::kNoLimit));
  safety.soft_upper = given.number("soft_upper_limit", upper, Range::any(limits::kNoLimit));
  safety.k_position = given.number("k_position", 0.0, Range::not_negative());
  safety.k_velocity = given.number("k_velocity", 0.0, Range::not_negative());
  if (safety.soft_lower > safety.soft_upper) {
    throw Error(at, "<safety_controller> has its soft_lower_limit " +
                        number_text(safety.soft_lower) + " above its soft_upper_limit " +
                        number_text(safety.soft_upper) + "; exchange them");
  }
  return safety;
}

void read_limit(const Reader& limit, const Element& joint, bool free, desc::JointAxis& axis) {
  const double lower = limit_of(limit, "lower", -kFree);
  const double upper = limit_of(limit, "upper", kFree);
  if (lower > upper) {
    throw Error(limit.element().source, "the limits of " + tag_of(joint) +
                                            ": lower exceeds upper, " + number_text(lower) + " > " +
                                            number_text(upper));
  }
  if (!free) {
    axis.lower = std::max(-kFree, lower);
    axis.upper = std::min(kFree, upper);
  }
  axis.effort = std::max(-1.0, limit.number("effort", -1.0, Range::any(kFinite)));
  axis.velocity = std::max(-1.0, limit.number("velocity", -1.0, Range::any(kFinite)));
}

void read_dynamics(const Reader& dynamics, bool has_spring, desc::JointAxis& axis) {
  axis.damping = dynamics.number("damping", 0.0, Range::solver(1e-9, 1e12));
  axis.friction = dynamics.number("friction", 0.0, Range::solver(0.0, 1e12));
  if (!has_spring) return;
  axis.spring_stiffness = dynamics.number("spring_stiffness", 0.0, Range::not_negative());
  axis.spring_reference = dynamics.number("spring_reference", 0.0, Range::any(limits::kNoLimit));
}

desc::JointAxis axis_of(const Reader& element, const Element& joint, const std::string& scope,
                        Frames& frames, Session& session) {
  const std::string& type = *joint.attribute("type");
  const bool free = type == "continuous";
  desc::JointAxis axis;
  const Vec3 xyz = element.direction("xyz", Vec3::UnitZ());
  const Element* given = element.child("xyz");
  const std::string* frame =
      given == nullptr ? nullptr : Reader(*given, session).attribute("expressed_in");
  const Quat& turn = frame == nullptr || frame->empty()
                         ? frames.joint_pose(scope + name_of(joint)).rotation
                         : frames.rotation(*frame, scope, element.element());
  axis.xyz = (turn * xyz).normalized();
  read_limit(element.block("limit"), joint, free, axis);
  read_dynamics(element.block("dynamics"), type != "universal", axis);
  axis.initial_position = element.number("initial_position", 0.0, Range::any(limits::kPosition));
  axis.safety = safety_of(element.block(kSafety), axis.lower, axis.upper);
  const bool endless = free || (axis.lower <= -kFree && axis.upper >= kFree);
  if (axis.safety && endless) axis.safety->k_position = 0.0;
  return axis;
}

// SDF's thread_pitch is in rad/m, and positive for a left-handed thread, as Gazebo has it.
double lead_of(const Reader& reader, const Element& joint) {
  const double pitch = reader.number("thread_pitch", 1.0, Range::any(kFinite));
  if (std::abs(pitch) >= kLeastPitch) return -1.0 / pitch;
  throw Error(reader.child("thread_pitch")->source,
              "the <thread_pitch> of " + tag_of(joint) + " is " + number_text(pitch) +
                  " rad/m; it must be at least " + number_text(kLeastPitch) + " or at most -" +
                  number_text(kLeastPitch));
}

void check_universal(const desc::Joint& joint, const Element& element) {
  if (std::abs(joint.axes[0].xyz.dot(joint.axes[1].xyz)) <= kMostParallel) return;
  throw Error(element.source, "the <axis> and <axis2> of " + tag_of(element) +
                                  " are parallel; give them different directions");
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

desc::Joint joint_of(const Element& element, const std::string& scope, Frames& frames,
                     Session& session) {
  const Reader reader(element, session);
  desc::Joint joint;
  joint.name = scope + name_of(element);
  joint.source = element.source;
  joint.type = type_of(*reader.attribute("type"));
  joint.parent = frames.link_of(reader.text("parent"), scope, element);
  joint.child = frames.link_of(reader.text("child"), scope, element);
  joint.anchor = frames.joint_pose(joint.name).position;
  if (joint.type == desc::Joint::Type::kFixed || joint.type == desc::Joint::Type::kBall) {
    return joint;
  }
  joint.axes.push_back(axis_of(reader.block("axis"), element, scope, frames, session));
  if (joint.type == desc::Joint::Type::kScrew) joint.lead = lead_of(reader, element);
  if (joint.type == desc::Joint::Type::kUniversal) {
    joint.axes.push_back(axis_of(reader.block("axis2"), element, scope, frames, session));
    check_universal(joint, element);
  }
  return joint;
}

}  // namespace angen::load

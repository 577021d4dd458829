#include "document/values.h"

#include <cmath>
#include <optional>

#include "core/limits.h"
#include "core/text.h"

namespace angen::load {

std::vector<double> numbers_of(const Element& element, std::size_t count) {
  const Numbers found = numbers_in(element.text);
  const std::string want = count == 1 ? "one number" : std::to_string(count) + " numbers";
  if (!found.bad.empty()) {
    throw Error(element.source, "<" + element.name + "> contains '" + printable(found.bad) +
                                    "', which is not a number; give " + want);
  }
  if (found.values.size() != count) {
    throw Error(element.source, "<" + element.name + "> contains " +
                                    std::to_string(found.values.size()) + " numbers; give " + want);
  }
  for (const double value : found.values) {
    if (!std::isfinite(value)) {
      throw Error(element.source, "<" + element.name + "> is not finite; give " + want);
    }
  }
  return found.values;
}

double number_of(const Element& element) { return numbers_of(element, 1)[0]; }

bool flag_of(const Element& element) {
  const std::string& t = element.text;
  if (t == "true" || t == "1" || t == "True" || t == "TRUE") return true;
  if (t == "false" || t == "0" || t == "False" || t == "FALSE") return false;
  throw Error(element.source,
              "<" + element.name + "> contains '" + printable(t) + "'; give true or false");
}

namespace {

// Angles in radians.
void check_pose(const Pose& pose, const std::vector<double>& angles, const Element& element) {
  std::string problem = pose_problem(pose);
  for (const double angle : angles) {
    const std::string wrong = limit_problem(limits::kAngle, angle);
    if (problem.empty() && !wrong.empty()) {
      problem = "an angle is " + number_text(angle) + " rad; " + wrong;
    }
  }
  if (!problem.empty()) throw Error(element.source, "<" + element.name + ">: " + problem);
}

}  // namespace

Pose pose_of(const Element& element) {
  if (element.text.empty()) return {};
  Pose pose;
  if (element.attribute_text("rotation_format") == "quat_xyzw") {
    const std::vector<double> v = numbers_of(element, 7);
    pose.rotation = Quat(v[6], v[3], v[4], v[5]);
    if (!(pose.rotation.norm() >= 1e-6 && pose.rotation.norm() <= 1e6)) {
      throw Error(element.source,
                  "<pose> contains a quaternion of length 0 or infinite; give a unit quaternion");
    }
    pose.rotation.normalize();
    pose.position = {v[0], v[1], v[2]};
    check_pose(pose, {}, element);
    return pose;
  }
  const std::vector<double> v = numbers_of(element, 6);
  const std::string degrees = element.attribute_text("degrees");
  const double unit = degrees == "true" || degrees == "1" ? M_PI / 180.0 : 1.0;
  pose.position = {v[0], v[1], v[2]};
  pose.rotation = from_rpy(v[3] * unit, v[4] * unit, v[5] * unit);
  check_pose(pose, {v[3] * unit, v[4] * unit, v[5] * unit}, element);
  return pose;
}

double child_number(const Element& element, const std::string& name, double fallback) {
  const Element* child = element.child(name);
  return child == nullptr ? fallback : number_of(*child);
}

bool child_flag(const Element& element, const std::string& name, bool fallback) {
  const Element* child = element.child(name);
  return child == nullptr ? fallback : flag_of(*child);
}

Pose child_pose(const Element& element) {
  const Element* child = element.child("pose");
  return child == nullptr ? Pose{} : pose_of(*child);
}

namespace {

// To a picometer and a picoradian: then two saves in a row are equal.
double rounded(double value) {
  constexpr double kSteps = 1e12;
  if (std::abs(value) > 1e3) return value;
  const double kept = std::round(value * kSteps) / kSteps;
  return kept == 0.0 ? 0.0 : kept;
}

}  // namespace

std::string pose_text(const Pose& pose) {
  const Vec3 rpy = to_rpy(pose.rotation);
  std::string text;
  for (const double v :
       {pose.position.x(), pose.position.y(), pose.position.z(), rpy.x(), rpy.y(), rpy.z()}) {
    text += (text.empty() ? "" : " ") + number_text(rounded(v));
  }
  return text;
}

}  // namespace angen::load

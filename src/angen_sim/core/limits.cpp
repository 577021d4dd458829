#include "core/limits.h"

#include <cmath>
#include <map>

#include "core/text.h"

namespace angen {

namespace {

std::string with_unit(double value, const Limit& limit) {
  return number_text(value) + (*limit.unit == '\0' ? "" : " ") + limit.unit;
}

}  // namespace

std::string limit_problem(const Limit& limit, double value, bool positive) {
  if (!std::isfinite(value)) return "it must be finite";
  if (value > limit.most) return "it must be at most " + with_unit(limit.most, limit);
  if (value < -limit.most) return "it must be at least " + with_unit(-limit.most, limit);
  if (positive && value < limit.least) {
    return "it must be at least " + with_unit(limit.least, limit);
  }
  return "";
}

const Limit& limit_of_unit(const std::string& unit) {
  using namespace limits;
  static const std::map<std::string, const Limit*> by_unit = [] {
    std::map<std::string, const Limit*> all;
    for (const Limit* limit : {&kPosition, &kAngle, &kMass, &kSpeed, &kTurnRate, &kAcceleration,
                               &kForce, &kTorque, &kTime, &kRate, &kTemperature}) {
      all[limit->unit] = limit;
    }
    return all;
  }();
  const auto found = by_unit.find(unit);
  return found == by_unit.end() ? kOther : *found->second;
}

std::string pose_problem(const Pose& pose) {
  if (!pose.finite()) return "the pose is not finite; give x y z roll pitch yaw as numbers";
  for (const double value : pose.position) {
    const std::string problem = limit_problem(limits::kPosition, value);
    if (!problem.empty()) {
      return "the position is " + with_unit(value, limits::kPosition) + "; " + problem;
    }
  }
  return "";
}

}  // namespace angen

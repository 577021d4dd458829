#include "core/limits.h"

#include <Eigen/Eigenvalues>
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

namespace {

// Ratios at which the solver keeps no digits.
std::string ratio_problem(double mass, const Vec3& moments, const std::string& all) {
  if (moments[0] < limits::kMoment.least || moments[0] < limits::kLeastMomentRatio * moments[2]) {
    return "the principal moments of inertia are " + all + "; the least must be at least " +
           number_text(limits::kMoment.least) + " kg m^2 and " +
           number_text(limits::kLeastMomentRatio) + " of the greatest";
  }
  for (const double principal : {moments[0], moments[2]}) {
    const double gyration = std::sqrt(principal / mass);
    const std::string wrong = limit_problem(limits::kGyration, gyration, true);
    if (wrong.empty()) continue;
    return "a radius of gyration, sqrt(" + number_text(principal) + " kg m^2 / " +
           number_text(mass) + " kg), is " + number_text(gyration) + " m; " + wrong;
  }
  return "";
}

}  // namespace

std::string inertia_problem(double mass, const Eigen::Matrix3d& moment) {
  if (!(mass > 0.0)) {
    return "the mass is " + number_text(mass) + " kg; it must be greater than 0";
  }
  if (const std::string wrong = limit_problem(limits::kMass, mass, true); !wrong.empty()) {
    return "the mass is " + number_text(mass) + " kg; " + wrong;
  }
  if (!moment.allFinite()) return "a moment of inertia is not a finite number";
  const double largest = moment.cwiseAbs().maxCoeff();
  if (const std::string wrong = limit_problem(limits::kMoment, largest); !wrong.empty()) {
    return "a moment of inertia is " + number_text(largest) + " kg m^2; " + wrong;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moment, Eigen::EigenvaluesOnly);
  const Vec3& moments = solver.eigenvalues();
  const std::string all = number_text(moments[0]) + ", " + number_text(moments[1]) + ", " +
                          number_text(moments[2]) + " kg m^2";
  if (!(moments[0] > 0.0)) {
    return "the principal moments of inertia are " + all + "; all must be greater than 0";
  }
  if (moments[0] + moments[1] < moments[2] * (1.0 - 1e-6)) {
    return "no body has the principal moments of inertia " + all +
           ": the greatest must not exceed the sum of the others";
  }
  return ratio_problem(mass, moments, all);
}

}  // namespace angen

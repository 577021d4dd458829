#pragma once

#include <string>

#include "core/pose.h"

namespace angen {

/// Bounds of a number: at most `most` in magnitude and, if it must not be 0, at least `least`.
struct Limit {
  const char* unit;
  double most;
  double least = 1e-12;
};

/// Limits of all input (files, spawns, commands, Python) and of moving bodies.
/// Within them every square, product and quotient of the solver and every float of the ray caster
/// stays finite; beyond them their libraries abort the process. Docs: docs/models.md.
namespace limits {

constexpr Limit kPosition{"m", 1e6, 1e-9};  // float: 6 cm there
constexpr Limit kLength{"m", 1e5, 1e-9};    // size of a shape
constexpr Limit kScale{"", 1e9, 1e-9};      // scale of a mesh
constexpr Limit kDirection{"", 1e9, 1e-9};  // length of a vector that is normalized
constexpr Limit kAngle{"rad", 1e6};         // more turns than a double tells apart to 1e-9
constexpr Limit kMass{"kg", 1e9, 1e-9};     // mass of a link
constexpr Limit kMoment{"kg m^2", 1e15, 1e-18};
constexpr Limit kGyration{"m", 1e5, 1e-8};   // sqrt(moment / mass)
constexpr double kLeastMomentRatio = 1e-12;  // a link's smallest principal moment by its largest
constexpr Limit kSpeed{"m/s", 1e5};
constexpr Limit kTurnRate{"rad/s", 1e5};
constexpr Limit kAcceleration{"m/s^2", 1e6};
constexpr Limit kGravity{"m/s^2", 1e4};
constexpr Limit kForce{"N", 1e9};
constexpr Limit kTorque{"N m", 1e9};
constexpr Limit kTime{"s", 1e9, 1e-9};  // 31 years; nanoseconds fit into 64 bits
constexpr Limit kRate{"Hz", 1e6};
constexpr Limit kTemperature{"K", 1e6, 1e-3};
constexpr Limit kColor{"", 1e6};
constexpr Limit kIntensity{"", 1e9};
constexpr Limit kNoLimit{"", 1e16};  // SDF's way to write "no limit"
constexpr Limit kOther{"", 1e16};    // units that are not listed

}  // namespace limits

/// "it must be at most 1e+06 m" for a number beyond its limit or not finite, "" for a good one.
/// `positive`: it must also reach the limit's `least`.
std::string limit_problem(const Limit& limit, double value, bool positive = false);

/// The limit of a parameter or a command's number, by its unit.
const Limit& limit_of_unit(const std::string& unit);

/// "the position is 1e+19 m; it must be …" for a pose beyond the limits, "" for a good one.
std::string pose_problem(const Pose& pose);

/// Why no body has that mass (kg) and these moments of inertia (kg m^2), or the solver cannot use
/// them: each principal moment must be positive, none above the sum of the others, all within
/// limits. Empty for good ones.
std::string inertia_problem(double mass, const Eigen::Matrix3d& moment);

}  // namespace angen

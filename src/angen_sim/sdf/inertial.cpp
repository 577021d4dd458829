#include <Eigen/Eigenvalues>

#include "core/limits.h"
#include "document/values.h"
#include "document/xml.h"
#include "sdf/describe.h"

namespace angen::load {

namespace {

// A body that exists, of nearly those moments: they are raised until each is above 0 and none
// exceeds the sum of the others.
desc::Inertial possible(desc::Inertial inertial) {
  constexpr double kMinGyration = 1e-3;  // m
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertial.moment);
  const double least = inertial.mass * kMinGyration * kMinGyration;
  Vec3 moments = solver.eigenvalues().cwiseMax(least);  // ascending
  const double missing = std::max(0.0, moments[2] - moments[0] - moments[1]);
  moments[0] += missing / 2.0;
  moments[1] += missing / 2.0;
  const Eigen::Matrix3d& axes = solver.eigenvectors();
  inertial.moment = axes * moments.asDiagonal() * axes.transpose();
  return inertial;
}

desc::Inertial read_inertial(const Reader& link, bool never_moves, Session& session) {
  desc::Inertial inertial;
  const Reader element = link.block("inertial");
  if (!element) return inertial;
  Source at = element.element().source;
  if (const Element* mass = element.child("mass")) {
    inertial.mass = element.number("mass", 0.0, Range::any(kFinite));
    at = mass->source;
  }
  inertial.pose = child_pose(element.element());
  if (const Reader inertia = element.block("inertia")) {
    const auto value = [&](const char* name, double fallback) {
      return inertia.number(name, fallback, Range::any(kFinite));
    };
    const double xx = value("ixx", 1.0), yy = value("iyy", 1.0), zz = value("izz", 1.0);
    const double xy = value("ixy", 0.0), xz = value("ixz", 0.0), yz = value("iyz", 0.0);
    inertial.moment << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    if (inertial.mass > 0.0) at = inertia.element().source;
  }
  const std::string wrong = inertia_problem(inertial.mass, inertial.moment);
  if (wrong.empty()) return inertial;
  const std::string message = tag_of(link.element()) + ": " + wrong;
  if (!never_moves && session.dialect->corrects_values() && is_possible(possible(inertial))) {
    session.warn(at, message + " (the nearest that a body can have is used)");
    return possible(inertial);
  }
  if (!never_moves) throw Error(at, message);
  session.warn(at, message + " (the model is static, so it is not used)");
  return {};
}

}  // namespace

bool is_possible(const desc::Inertial& inertial) {
  return inertia_problem(inertial.mass, inertial.moment).empty();
}

desc::Inertial inertial_of(const Reader& link, bool never_moves, Session& session) {
  if (!never_moves) return read_inertial(link, never_moves, session);
  try {
    return read_inertial(link, never_moves, session);
  } catch (const Error& error) {
    session.warn_or_throw(error);  // bad numbers do not matter for a static link
    return {};
  }
}

}  // namespace angen::load

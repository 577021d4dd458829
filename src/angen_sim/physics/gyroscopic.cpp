#include "physics/gyroscopic.h"

#include <Eigen/LU>
#include <utility>

namespace angen::physics {

namespace {

constexpr double kSlowSpin =
    1.0;                         // rad/s: ODE loses 0.1 % of the energy in 20 s, with steps of 1 ms
constexpr double kRound = 1e-9;  // share by which moments differ that have no such torque
constexpr double kSteady = 0.5;  // share by which a torque changes that is expected to stay
constexpr double kMostTurn = 0.5;  // rad in a step
constexpr int kMostTries = 20;
constexpr double kSpinError = 1e-13;  // share of the spin

Vec3 rotated(const Vec3& v, const Vec3& angle) {
  const double norm = angle.norm();
  return norm > 0.0 ? Vec3(Eigen::AngleAxisd(norm, angle / norm) * v) : v;
}

Eigen::Matrix3d cross_matrix(const Vec3& v) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return matrix;
}

bool is_round(const Eigen::Matrix3d& moment) {
  return moment.isApprox(moment(0, 0) * Eigen::Matrix3d::Identity(), kRound);
}

}  // namespace

// A step turns a body by its spin. In the middle of the last turn, and of the next one, the spin
// times the moment is the momentum (the midpoint rule of Lie groups).
std::optional<Vec3> next_spin(const Eigen::Matrix3d& moment, const Vec3& spin, const Vec3& impulse,
                              double step) {
  if (spin.norm() * step > kMostTurn) return std::nullopt;
  const double half = 0.5 * step;
  const Vec3 momentum = rotated(moment * spin, -half * spin) + impulse;
  Vec3 next = spin;
  for (int i = 0; i < kMostTries; ++i) {
    const Vec3 there = rotated(momentum, -half * next);
    const Vec3 change = (moment - half * cross_matrix(there)).inverse() * (there - moment * next);
    next += change;
    if (!next.allFinite() || next.norm() * step > 2.0 * kMostTurn) return std::nullopt;
    if (change.norm() <= kSpinError * next.norm()) return next;
  }
  return std::nullopt;
}

void add_gyroscopic_torques(const std::vector<Body*>& awake, double step) {
  for (Body* body : awake) {
    dBodyID ode = body->ode.get();
    Gyroscopic& own = body->gyroscopic;
    const Quat to_own = body->at.rotation.conjugate();
    const Vec3 spin = to_own * body->spin();
    std::optional<Vec3> next;
    if (spin.norm() > kSlowSpin && !body->upright && !is_round(body->moment)) {
      next = next_spin(body->moment, spin, to_own * own.expected * step, step);
    }
    own.acts = next.has_value();
    dBodySetGyroscopicMode(ode, own.acts ? 0 : 1);
    if (!next) continue;
    own.spin = body->spin();
    own.torque = body->at.rotation * (body->moment * (*next - spin) / step) - own.expected;
    dBodyAddTorque(ode, own.torque.x(), own.torque.y(), own.torque.z());
  }
}

void note_torques(const std::vector<Body*>& awake, double step) {
  for (Body* body : awake) {
    Gyroscopic& own = body->gyroscopic;
    const Vec3 before = std::exchange(own.others, Vec3::Zero());
    own.expected = Vec3::Zero();
    if (!own.acts || body->parts) continue;
    const Vec3 gained = body->at.rotation.conjugate() * (body->spin() - own.spin);
    const Vec3 all = body->at.rotation * (body->moment * gained) / step;
    if (!all.allFinite()) continue;
    own.others = all - own.torque;
    // Not if it is that of an impact: it ends with the step.
    const bool stays = (own.others - before).norm() < kSteady * own.others.norm();
    if (stays) own.expected = own.others;
  }
}

}  // namespace angen::physics

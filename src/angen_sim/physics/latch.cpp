#include <algorithm>
#include <cmath>

#include "physics/joints.h"

namespace angen::physics {

namespace {

constexpr double kLatchTime = 0.1;  // s
constexpr double kBlow = 10.0;      // times its force: a blow shorter than 10 ms does not break it
constexpr double kLatchSpeed = 0.002;  // rad/s or m/s
constexpr double kLatchAgain = 0.9;    // share of its force

}  // namespace

void watch_latch(Joint& joint, double h) {
  if (!joint.latched || !std::isfinite(joint.latch_force)) return;
  const double most = kBlow * joint.latch_force;
  const double borne = std::clamp(joint.effort - joint.spring_effort, -most, most);
  joint.latch_strain += (borne - joint.latch_strain) * h / (h + kLatchTime);
  const double strain = std::abs(joint.latch_strain);
  const bool at_rest = std::abs(joint_velocity(joint)) < kLatchSpeed;
  const bool breaks = !joint.latch_broken && strain >= joint.latch_force;
  const bool catches = joint.latch_broken && at_rest && strain < kLatchAgain * joint.latch_force;
  if (!breaks && !catches) return;
  joint.latch_broken = breaks;
  joint.latch_at = ode_position(joint);
  apply_latch(joint);
}

}  // namespace angen::physics

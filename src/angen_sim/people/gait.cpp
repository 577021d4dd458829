#include "people/gait.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace angen::people {

namespace {

constexpr double kStride = 1.4;     // m of two steps
constexpr double kStands = 0.02;    // m/s
constexpr double kFull = 1.2;       // m/s, from which the limbs swing most
constexpr double kWidest = 0.5;     // rad, of a thigh to each side
constexpr double kArm = 0.8;        // share of a thigh's swing
constexpr double kKnee = 1.2;       // share of a thigh's swing, while the leg swings ahead
constexpr double kElbow = 0.5;      // share of a thigh's swing, always
constexpr double kElsewhere = 0.5;  // m at once: it was placed there

struct Limb {
  const char* name;
  int parent;  // another limb; -1: none
  double side;
  double height;  // m of its joint above the floor
};

constexpr std::array<Limb, Gait::kLimbs> kLimb{{{"thigh_left", -1, 1.0, 0.90},
                                                {"thigh_right", -1, -1.0, 0.90},
                                                {"shank_left", 0, 1.0, 0.47},
                                                {"shank_right", 1, -1.0, 0.47},
                                                {"upper_arm_left", -1, 1.0, 1.42},
                                                {"upper_arm_right", -1, -1.0, 1.42},
                                                {"forearm_left", 4, 1.0, 1.12},
                                                {"forearm_right", 5, -1.0, 1.12}}};
constexpr int kShank = 2;  // the first of each pair
constexpr int kUpperArm = 4;
constexpr int kForearm = 6;

/// A turn about the y axis at a height.
Pose turned(double height, double angle) {
  const Quat turn(Eigen::AngleAxisd(angle, Vec3::UnitY()));
  const Vec3 joint(0.0, 0.0, height);
  return {joint - turn * joint, turn};
}

}  // namespace

std::vector<Anatomy::Names> Gait::visuals() {
  std::vector<Anatomy::Names> visuals;
  for (const Limb& limb : kLimb) visuals.push_back({limb.name});
  visuals[kShank].emplace_back("foot_left");
  visuals[kShank + 1].emplace_back("foot_right");
  return visuals;
}

void Gait::advance(const Pose& pose, double speed) {
  const double way = (pose.position - at_).head<2>().norm();
  at_ = pose.position;
  if (speed < kStands) {
    phase_ = swing_ = 0.0;
    return;
  }
  if (way < kElsewhere) phase_ = std::fmod(phase_ + 2.0 * M_PI * way / kStride, 2.0 * M_PI);
  swing_ = kWidest * std::min(speed / kFull, 1.0);
}

Pose Gait::limb(int number) const {
  const Limb& limb = kLimb.at(static_cast<std::size_t>(number));
  const double ahead = limb.side * std::sin(phase_);  // -1 to 1
  double angle = -swing_ * ahead;                     // ahead is a turn below 0 about y
  if (number >= kForearm) {
    angle = -kElbow * swing_;
  } else if (number >= kUpperArm) {
    angle = kArm * swing_ * ahead;
  } else if (number >= kShank) {
    angle = kKnee * swing_ * std::max(0.0, limb.side * std::cos(phase_));
  }
  const Pose own = turned(limb.height, angle);
  return limb.parent < 0 ? own : this->limb(limb.parent) * own;
}

}  // namespace angen::people

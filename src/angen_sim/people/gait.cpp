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
                                                {"forearm_right", 5, -1.0, 1.12},
                                                {"trunk", -1, 0.0, 1.15}}};
constexpr int kShank = 2;  // the first of each pair
constexpr int kUpperArm = 4;
constexpr int kForearm = 6;
constexpr int kTrunk = 8;

constexpr double kSeatedLimbs[] = {-1.57, 1.53, -0.3, -1.2, 0.0};  // rad, of each pair
constexpr double kHips = -0.82;                                    // m, from standing to the seat
const Vec3 kLies(-0.97, 0.0, 0.17);                                // m, of the feet

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
  for (const char* name : {"neck", "head", "hair", "nose"}) visuals[kTrunk].emplace_back(name);
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

double Gait::angle(int number) const {
  if (posture_ == Posture::kSit) return kSeatedLimbs[number / 2];
  const double ahead = kLimb.at(static_cast<std::size_t>(number)).side * std::sin(phase_);
  if (posture_ == Posture::kLie || number == kTrunk) return 0.0;
  if (number >= kForearm) return -kElbow * swing_;
  if (number >= kUpperArm) return kArm * swing_ * ahead;
  if (number < kShank) return -swing_ * ahead;  // ahead is a turn below 0 about y
  const double side = kLimb.at(static_cast<std::size_t>(number)).side;
  return kKnee * swing_ * std::max(0.0, side * std::cos(phase_));
}

Pose Gait::limb(int number) const {
  const Limb& limb = kLimb.at(static_cast<std::size_t>(number));
  const Pose own = turned(limb.height, angle(number));
  if (limb.parent >= 0) return this->limb(limb.parent) * own;
  if (posture_ == Posture::kSit) return Pose{{0.0, 0.0, kHips}, Quat::Identity()} * own;
  // On its back, head ahead.
  const Quat back(Eigen::AngleAxisd(M_PI, Vec3(1.0, 0.0, 1.0).normalized()));
  return posture_ == Posture::kLie ? Pose{kLies, back} * own : own;
}

}  // namespace angen::people

#pragma once

#include "core/anatomy.h"
#include "core/pose.h"
#include "people/modes.h"

namespace angen::people {

/// The swing of the limbs of a walking person: thighs, shanks, upper arms and forearms, left and
/// right. Those of a standing person do not swing; with the trunk, they also sit and lie.
class Gait {
 public:
  static constexpr int kLimbs = 9;

  /// The visuals of each limb.
  static std::vector<Anatomy::Names> visuals();

  /// The body is at `pose` now, at `speed` m/s.
  void advance(const Pose& pose, double speed);

  void take(Posture posture) { posture_ = posture; }

  /// The motion of a limb from its place in the standing body, in the body's frame.
  Pose limb(int number) const;

 private:
  double angle(int number) const;

  Posture posture_ = Posture::kStand;
  Vec3 at_ = Vec3::Zero();
  double phase_ = 0.0;  // rad; two steps are a turn
  double swing_ = 0.0;  // rad, of the thighs to both sides
};

}  // namespace angen::people

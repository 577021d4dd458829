#pragma once

#include <string>

#include "core/pose.h"

namespace angen::sim {

/// The limbs of a walking person: thighs, shanks, upper arms and forearms, left and right.
constexpr int kLimbs = 8;

constexpr int kNoLimb = -1;

/// The limb that a visual of a person is a part of, by its name; kNoLimb for head and trunk.
int limb_of(const std::string& visual);

/// The swing of the limbs of a walking person. Those of a standing person do not swing.
class Gait {
 public:
  /// The body is at `pose` now, at `speed` m/s.
  void advance(const Pose& pose, double speed);

  bool swings() const { return swing_ > 0.0; }

  /// The motion of a limb from its place in the standing body, in the body's frame.
  Pose limb(int number) const;

 private:
  Vec3 at_ = Vec3::Zero();
  double phase_ = 0.0;  // rad; two steps are a turn
  double swing_ = 0.0;  // rad, of the thighs to both sides
};

}  // namespace angen::sim

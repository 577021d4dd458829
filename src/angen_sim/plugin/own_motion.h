#pragma once

#include "core/pose.h"

namespace angen {

/// The velocity of a place on a link, and how it changed between two samples.
class OwnMotion {
 public:
  /// Notes the place (world, m) and its velocity (world, m/s), `seconds` after the last ones.
  void note(const Pose& place, const Vec3& velocity, double seconds) {
    mean_ = known_ ? Vec3((velocity - velocity_) / seconds) : Vec3(Vec3::Zero());
    middle_ = known_ ? rotation_.slerp(0.5, place.rotation) : place.rotation;
    rotation_ = place.rotation;
    velocity_ = velocity;
    known_ = true;
  }
  /// What is noted next is after a rest.
  void forget() { known_ = false; }

  /// m/s^2, in the world: the mean of the time between the last two samples.
  const Vec3& acceleration() const { return mean_; }
  /// What an accelerometer there measures of it, besides `gravity` (m/s^2, world), along its own
  /// axes: those of the acceleration are the ones that it had in the middle of that time, so that
  /// even turning reads as toward the center.
  Vec3 felt(const Vec3& gravity) const {
    const Vec3 weight = rotation_.conjugate() * -gravity;
    return mean_.isZero(0.0) ? weight : Vec3(weight + middle_.conjugate() * mean_);
  }

 private:
  bool known_ = false;
  Vec3 velocity_ = Vec3::Zero();
  Vec3 mean_ = Vec3::Zero();
  Quat rotation_ = Quat::Identity();
  Quat middle_ = Quat::Identity();
};

}  // namespace angen

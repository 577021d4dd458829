#pragma once

#include <string>
#include <vector>

#include "core/pose.h"

namespace angen {

/// One point where two collisions touch, in the world frame.
struct ContactPoint {
  Vec3 position = Vec3::Zero();  // m
  Vec3 normal = Vec3::UnitZ();   // unit, from the second body towards the first
  double depth = 0.0;            // m, positive when they overlap
  Vec3 force = Vec3::Zero();     // N on the first body; the second feels its opposite
};

/// Everything that touches between two collisions; names are `model::link::collision`.
struct ContactPair {
  std::string first;
  std::string second;
  std::vector<ContactPoint> points;
};

}  // namespace angen

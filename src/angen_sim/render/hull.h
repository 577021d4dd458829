#pragma once

#include <array>

#include "render/box_tree.h"

namespace angen::render {

/// A convex polygon of three or four corners.
struct Face {
  std::array<Eigen::Vector3f, 4> corners;
  std::size_t count = 0;
};

/// The segments between two boxes: their convex hull (shaft culling, Haines and Wallace 1991). All
/// answers have margins that exceed the rounding of rays in floats.
class Hull {
 public:
  Hull(const Box& from, const Box& to);

  /// The hull in a frame that is turned and at `position` in that of the hull.
  Hull seen_from(const Eigen::Matrix3f& rotation, const Eigen::Vector3f& position) const;
  /// False only if no part of the box is in the hull.
  bool overlaps(const Box& box) const {
    if (!box.intersects(box_)) return false;
    Sides beyond = -offset_;
    for (int axis = 0; axis < 3; ++axis) {
      beyond += outward_[axis].max(0.0F) * box.min()[axis];
      beyond += outward_[axis].min(0.0F) * box.max()[axis];
    }
    return !(beyond.maxCoeff() > 0.0F);
  }
  /// False only if no part of the face is in the hull.
  bool overlaps(const Face& face) const;
  /// True only if all segments cross the face.
  bool is_cut_by(const Face& face) const;

 private:
  static constexpr int kMaxSides = 8;  // six, in whole registers
  static constexpr float kFarPlane = 1e30F;
  using Sides = Eigen::Array<float, kMaxSides, 1>;

  Hull() = default;
  void add_sides(int u, int v);
  float margin() const;

  Box from_, to_;  // in the frame of the constructor
  Box box_;        // around the hull, with the margin
  // The planes outward . p = offset of its sides; those that are not set are far away.
  std::array<Sides, 3> outward_ = {Sides::Zero(), Sides::Zero(), Sides::Zero()};
  Sides offset_ = Sides::Constant(kFarPlane);
  int side_count_ = 0;
};

}  // namespace angen::render

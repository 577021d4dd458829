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
  /// Boxes that have a part in the hull, and perhaps some beside it.
  Four overlaps(const Boxes4& boxes) const;
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
  bool may_be_cut_by(const Face& face) const;

  Box from_, to_;  // in the frame of the constructor
  Box box_;        // around the hull, with the margin
  // The planes outward . p = offset of its sides; those that are not set are far away.
  std::array<Sides, 3> outward_ = {Sides::Zero(), Sides::Zero(), Sides::Zero()};
  Sides offset_ = Sides::Constant(kFarPlane);
  int side_count_ = 0;
};

}  // namespace angen::render

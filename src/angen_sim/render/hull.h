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
  bool overlaps(const Box& box) const;
  /// True only if all segments cross the face.
  bool is_cut_by(const Face& face) const;

 private:
  struct Side {
    Eigen::Vector3f outward;
    float offset;  // of the plane: outward . p
  };

  Hull() = default;
  void add_sides(int u, int v);
  float margin() const;

  Box from_, to_;  // in the frame of the constructor
  Box box_;        // around the hull, with the margin
  std::array<Side, 12> sides_;
  std::size_t side_count_ = 0;
};

}  // namespace angen::render

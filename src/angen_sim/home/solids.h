#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "home/survey.h"

namespace angen {

/// A box around a shape, in the world.
struct OrientedBox {
  Pose pose;  // pose of its middle
  Vec3 size = Vec3::Zero();
  bool round = false;  // a cylinder or capsule about z

  Eigen::AlignedBox3d bounds() const;
};

/// The box around a shape in `frame`; none for planes, heightmaps and empty shapes.
std::optional<OrientedBox> box_around(const Shape& shape, const Pose& frame);

/// The overlap of two boxes, or of round shapes in them, along the direction in which they do
/// least, m; at most 0 if they are apart.
double overlap_of(const OrientedBox& a, const OrientedBox& b);

/// The boxes around the collisions of a model.
std::vector<OrientedBox> solid_boxes(const HomeSurvey::Standing& standing);

}  // namespace angen

#pragma once

#include <array>

#include "core/shape.h"

namespace angen::render {

/// A shape as triangles in its own frame, m. Round ones are inside the true surface by up to
/// 0.2 % of their radius; a plane without a size is 1 km wide. Bad sizes give no triangles.
TriangleMesh tessellate(const Shape& shape);

/// Texture coordinates of a triangle of a tessellated shape: u v of its three corners. The texture
/// is on each side of a box, once on a plane and around a round shape, and on each meter of an
/// endless plane.
std::array<float, 6> wrapped(const Shape& shape, const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                             const Eigen::Vector3f& c);

}  // namespace angen::render

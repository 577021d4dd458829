#pragma once

#include <array>

#include "core/shape.h"

namespace angen::render {

/// Where a picture lies on a triangle of a tessellated shape: u v of its three corners. A box has
/// it once on each side, a plane and what is round once in all, an endless plane once a meter.
std::array<float, 6> wrapped(const Shape& shape, const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                             const Eigen::Vector3f& c);

}  // namespace angen::render

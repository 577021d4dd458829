#pragma once

#include <vector>

#include "core/pose.h"

/// The directions in which a place gathers light, and its one-pixel view.
namespace angen::light {

constexpr std::size_t kDirections = 2048;

/// Cosine-weighted, in the frame of the place, which faces x.
const std::vector<Vec3>& gather_directions();

/// Weight of each direction in the view; their sum is 1.
const std::vector<float>& view_weights();

/// Whether the view's square image sees a direction of the place's frame.
bool in_view(const Vec3& local);

/// Area of the image on the plane 1 m ahead, m^2.
double view_area();

}  // namespace angen::light

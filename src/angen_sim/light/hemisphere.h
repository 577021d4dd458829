#pragma once

#include <array>
#include <vector>

#include "core/pose.h"

/// The directions in which a place gathers light, and its one-pixel view.
namespace angen::light {

constexpr std::size_t kDirections = 2048;
constexpr std::size_t kFineDirections = 8;  // in the cell of one of them

/// Cosine-weighted, in the frame of the place, which faces x. There is one in each cell of a
/// lattice: 16 rings, each with 128 parts of its circle, all of the same weight.
const std::vector<Vec3>& gather_directions();

/// By direction: those of the four cells beside its own; itself beyond the outermost and the
/// innermost ring.
const std::vector<std::array<std::size_t, 4>>& neighbors();

/// More directions in the cell of direction `i`, evenly spread.
std::array<Vec3, kFineDirections> fine_directions(std::size_t i);

/// Weight of each direction in the view; their sum is 1.
const std::vector<float>& view_weights();

/// Whether the view's square image sees a direction of the place's frame.
bool in_view(const Vec3& local);

/// Area of the image on the plane 1 m ahead, m^2.
double view_area();

}  // namespace angen::light

#pragma once

#include <vector>

#include "light/lamp.h"
#include "light/surfaces.h"

/// The rays by which a Field finds where light goes. Always the same.
namespace angen::light {

constexpr std::size_t kLinks = 128;     // directions in which a patch gathers
constexpr std::size_t kFineLinks = 32;  // the same of a part of a divided cell

std::vector<rays::Ray> link_rays(const Patch& patch);

/// Rays that find what a lamp shines on in a world of that size.
std::vector<rays::Ray> first_rays(const Lamp& lamp, const Eigen::AlignedBox3d& world);

/// Where a ray of that range ends.
Vec3 end_of(const rays::Ray& ray, double range);

}  // namespace angen::light

#pragma once

#include <vector>

#include "light/lamp.h"
#include "light/surfaces.h"

/// The fixed rays by which a Field follows light.
namespace angen::light {

constexpr std::size_t kLinks = 128;     // directions in which a patch gathers
constexpr std::size_t kFineLinks = 32;  // links of a part of a divided cell

/// How many links a patch has.
inline std::size_t links_of(const Patch& patch) { return patch.is_part() ? kFineLinks : kLinks; }

std::vector<rays::Ray> link_rays(const Patch& patch);

/// Rays from a lamp that find the patches it lights; `world` (m) bounds the static shapes.
std::vector<rays::Ray> first_rays(const Lamp& lamp, const Eigen::AlignedBox3d& world);

/// The end (m, world) of a ray of that range, at 10 km at most.
Vec3 end_of(const rays::Ray& ray, double range);

}  // namespace angen::light

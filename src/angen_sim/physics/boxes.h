#pragma once

#include <cstddef>

#include "physics/ode.h"

namespace angen::physics {

/// As dCollide() of two boxes: up to `most` points in the world's frame, the normals towards `a`;
/// returns how many. ODE 0.16 overlooks some overlaps of boxes whose sides are all but parallel,
/// as those of all that stands upright are: rounding decides about axes that are no more than it.
std::size_t collide_boxes(dGeomID a, dGeomID b, dContactGeom* points, std::size_t most);

}  // namespace angen::physics

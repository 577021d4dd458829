#pragma once

#include <cstddef>

#include "physics/ode.h"

namespace angen::physics {

/// Like dCollide() of two boxes: up to `most` points in the world's frame, the normals towards `a`;
/// returns their number. ODE 0.16 overlooks some overlaps of boxes whose sides are all but
/// parallel, such as those of all upright boxes: rounding then decides between equal axes.
std::size_t collide_boxes(dGeomID a, dGeomID b, dContactGeom* points, std::size_t most);

}  // namespace angen::physics

#pragma once

#include "core/shape.h"

namespace angen::render {

/// A shape as triangles in its own frame, m. Round ones are inside the true surface by up to 0.2 %
/// of their radius; a plane without a size is 1 km wide. Bad sizes give no triangles.
TriangleMesh tessellate(const Shape& shape);

}  // namespace angen::render

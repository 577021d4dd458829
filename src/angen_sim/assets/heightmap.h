#pragma once

#include <memory>
#include <string>

#include "core/diagnostics.h"
#include "core/height_grid.h"

namespace angen::load {

/// A grayscale PNG as a surface of size x, y and height z, centered on the origin. Kept and shared
/// as meshes are.
std::shared_ptr<const HeightGrid> read_heightmap(const std::string& path, const Vec3& size,
                                                 const Source& at);

}  // namespace angen::load

#pragma once

#include "core/shape.h"
#include "load/expand.h"

namespace angen::load {

/// The shape of a checked <geometry>. `pose` is turned or moved where SDF says more than Shape does
/// (a plane's normal, a heightmap's position).
Shape shape_of(const Element& geometry, Pose& pose, Session& session);

/// A COLLADA, STL or OBJ file as triangles in meters, z up, times `scale`. Kept and shared while
/// somebody uses it and the file does not change. Throws Error at `at`.
std::shared_ptr<const TriangleMesh> read_mesh(const std::string& path, const Vec3& scale,
                                              const Source& at);

/// A grayscale PNG as a surface of size x, y and height z, centered on the origin.
std::shared_ptr<const TriangleMesh> read_heightmap(const std::string& path, const Vec3& size,
                                                   const Source& at);

}  // namespace angen::load

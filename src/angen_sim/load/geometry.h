#pragma once

#include "core/shape.h"
#include "load/expand.h"

namespace angen::load {

struct PlacedShape {
  Shape shape;
  Pose pose;
};

/// The shapes of a checked <geometry> that stands at `pose`: boxes of an <image>, else one.
std::vector<PlacedShape> shapes_of(const Element& geometry, const Pose& pose, Session& session);

/// The dark parts of a picture as boxes: its middle at the origin, its top towards +y, from z = 0
/// up. Few: neighbors are one box.
std::vector<PlacedShape> image_boxes(const Element& image, const Pose& pose, Session& session);

/// A COLLADA, STL or OBJ file as triangles in meters, z up, times `scale`. Kept and shared while
/// somebody uses it and the file does not change. Throws Error at `at`.
std::shared_ptr<const TriangleMesh> read_mesh(const std::string& path, const Vec3& scale,
                                              const Source& at);

/// A grayscale PNG as a surface of size x, y and height z, centered on the origin. Kept and shared
/// as meshes are.
std::shared_ptr<const HeightGrid> read_heightmap(const std::string& path, const Vec3& size,
                                                 const Source& at);

}  // namespace angen::load

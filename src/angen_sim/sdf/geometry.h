#pragma once

#include "core/shape.h"
#include "core/texture.h"
#include "sdf/reader.h"

namespace angen::load {

struct PlacedShape {
  Shape shape;
  Pose pose;
  std::shared_ptr<const MeshLook> look{};  // a mesh's
  std::string file{};                      // the file that it was read from
};

/// The shapes in the <geometry> of a <collision> or <visual> at `pose`: boxes of an <image>, else
/// one.
std::vector<PlacedShape> shapes_of(const Reader& part, const Pose& pose, Session& session);

/// The dark parts of a picture as boxes: its middle at the origin, its top towards +y, from z = 0
/// up. Few: neighbors are one box.
std::vector<PlacedShape> image_boxes(const Reader& image, const Pose& pose, Session& session);

/// The outlines of all <polyline>s of a <geometry>, extruded from z = 0 up; one in another is a
/// hole.
Shape polyline_prism(const Reader& geometry, Session& session);

}  // namespace angen::load

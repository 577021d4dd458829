#pragma once

#include "desc/world.h"
#include "sdf/expand.h"

namespace angen::load {

/// The colors of a <visual>: its <diffuse> and <emissive>, or those of the Gazebo script it names.
/// A script that is not known is a warning and leaves gray.
desc::Material material_of(const Element& visual, Session& session);

/// r g b or r g b a, each 0..1; alpha 1 when it is not given.
Eigen::Vector4f color_of(const Element& element);

}  // namespace angen::load

#pragma once

#include "desc/world.h"
#include "sdf/reader.h"

namespace angen::load {

/// The colors of a <visual>: its <diffuse> and <emissive>, or those of the Gazebo script it names.
/// A script that is not known is a warning and leaves gray.
desc::Material material_of(const Reader& visual, Session& session);

}  // namespace angen::load

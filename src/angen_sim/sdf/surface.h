#pragma once

#include <string>

#include "desc/world.h"
#include "sdf/geometry.h"

/// The look of visuals.
namespace angen::load {

/// The look of a mesh's file, on a visual whose SDF has no material of its own.
void paint(const PlacedShape& mesh, const Source& at, Session& session, desc::Material& material);

/// The texture that an Ogre material script gives a <script>'s name; false if it has no such
/// material.
bool paint_by_script(const Reader& script, Session& session, desc::Material& material);

}  // namespace angen::load

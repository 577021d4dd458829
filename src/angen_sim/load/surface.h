#pragma once

#include <string>

#include "desc/world.h"
#include "load/geometry.h"

/// What is painted on visuals.
namespace angen::load {

/// The file that another one, such as a mesh, names: beside it, or where models have their
/// textures.
/// "" with a warning where there is none, or none that `at` may name.
std::string find_beside(const std::string& name, const std::string& what, const std::string& file,
                        const Source& at, Session& session);

/// The look of a mesh's file, on a visual whose SDF has no material of its own.
void paint(const PlacedShape& mesh, const Source& at, Session& session, desc::Material& material);

/// The texture that an Ogre material script gives a <script>'s name; false where it has no such
/// material.
bool paint_by_script(const Element& script, Session& session, desc::Material& material);

}  // namespace angen::load

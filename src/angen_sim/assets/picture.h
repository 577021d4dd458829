#pragma once

#include <string>

#include "core/texture.h"

namespace angen::load {

/// A PNG or JPEG file as a texture of at most kMaxTextureSide a side: larger ones are averaged,
/// transparency is dropped. Throws Refused. Only angen_mesh calls it.
Texture picture_of(const std::string& bytes);

}  // namespace angen::load

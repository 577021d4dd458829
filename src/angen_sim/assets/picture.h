#pragma once

#include <string>

#include "assets/mesh.h"
#include "core/texture.h"

namespace angen::load {

/// A PNG or JPEG file as a texture of at most kMaxTextureSide a side: larger ones are averaged,
/// transparency is dropped. Throws Rejected. Only angen_mesh calls it.
Texture picture_of(const std::string& bytes);
/// A PNG's samples, of `least` to kMaxPngSide pixels a side.
GrayImage gray_picture_of(const std::string& bytes, unsigned least);

}  // namespace angen::load

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/pose.h"

namespace angen {

/// Triangles of one material in a mesh's file.
struct MeshPart {
  std::uint32_t first = 0;  // its first triangle; the part ends where the next one begins
  Eigen::Vector4f color{0.7F, 0.7F, 0.7F, 1.0F};  // diffuse r g b a, 0..1
  std::string texture;                            // the file that its material names, "" for none
};

/// The surface that a mesh file describes.
struct MeshLook {
  std::vector<MeshPart> parts;                // in the order of the triangles
  std::vector<std::array<float, 6>> corners;  // u v of each triangle's corners; empty: no texture
};

}  // namespace angen

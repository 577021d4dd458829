#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/pose.h"

namespace angen {

/// The linear value of an sRGB byte, 0..1 (IEC 61966-2-1).
float linear(std::uint8_t srgb);
/// The sRGB byte of a linear value; values outside 0..1 are clamped.
std::uint8_t srgb(double linear_value);

/// A picture on a surface, in sRGB as its file has it.
struct Texture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> bytes;  // r g b, row after row from the top

  /// Linear r g b, 0..1, at u to the right and v up from the lower left corner; it repeats beyond
  /// 0..1. Between texels it is interpolated.
  Eigen::Vector3f at(float u, float v) const;
  /// The mean of all of it, linear.
  Eigen::Vector3f mean() const;
};

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

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "core/height_grid.h"
#include "core/shape.h"
#include "core/texture.h"

namespace angen::load {

/// A mesh's file, and which part of it to read.
struct MeshSource {
  std::string path;
  Vec3 scale = Vec3::Ones();
  std::string submesh{};    // "" for all
  bool center = false;      // its box's middle becomes the origin
  std::string materials{};  // the file with an OBJ's materials, "" for none
};
struct ReadMesh {
  std::shared_ptr<const TriangleMesh> triangles;
  std::shared_ptr<const MeshLook> look;
};

/// A COLLADA, STL or OBJ file as triangles in meters, in its own axes, times the scale. Shared
/// while it is in use and the file does not change. Throws Error at `at`.
ReadMesh read_mesh(const MeshSource& source, const Source& at);
/// The name of an OBJ's file of materials, "" where it names none.
std::string materials_of(const std::string& path);

/// A PNG or JPEG file. Shared as meshes are. Throws Error.
std::shared_ptr<const Texture> read_texture(const std::string& path);

/// Samples as the file holds them, row by row from the image's top: gray values from 0 to 1, the
/// mean of a color image's. They are quantities: gAMA, sRGB and iCCP chunks do not change them.
struct GrayImage {
  unsigned width = 0;
  unsigned height = 0;
  std::vector<double> values;
};

constexpr unsigned kMaxPngSide = 2049;

/// A PNG of `least` to kMaxPngSide pixels a side; `what` names it in messages. Throws Error at
/// `at`.
GrayImage read_png(const std::string& path, const std::string& what, unsigned least,
                   const Source& at);

/// A grayscale PNG as a surface of size x, y and height z, centered on the origin. Kept
/// and shared as meshes are.
std::shared_ptr<const HeightGrid> read_heightmap(const std::string& path, const Vec3& size,
                                                 const Source& at);

}  // namespace angen::load

#pragma once

#include <memory>
#include <string>

#include "core/diagnostics.h"
#include "core/mesh_look.h"
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

}  // namespace angen::load

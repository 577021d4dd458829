#pragma once

#include "core/mesh_look.h"
#include "core/shape.h"
#include "core/texture.h"
#include "load/expand.h"

namespace angen::load {

struct PlacedShape {
  Shape shape;
  Pose pose;
  std::shared_ptr<const MeshLook> look{};  // of a mesh
  std::string file{};                      // that it was read from
};

/// The shapes of a checked <geometry> that stands at `pose`: boxes of an <image>, else one.
std::vector<PlacedShape> shapes_of(const Element& geometry, const Pose& pose, Session& session);

/// The dark parts of a picture as boxes: its middle at the origin, its top towards +y, from z = 0
/// up. Few: neighbors are one box.
std::vector<PlacedShape> image_boxes(const Element& image, const Pose& pose, Session& session);

/// A mesh's file, and what of it is wanted.
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

/// A COLLADA, STL or OBJ file as triangles in meters, z up, times the scale. Kept and shared while
/// somebody uses it and the file does not change. Throws Error at `at`.
ReadMesh read_mesh(const MeshSource& source, const Source& at);
/// The name of an OBJ's file of materials, "" where it names none.
std::string materials_of(const std::string& path);

/// A PNG or JPEG file. Kept and shared as meshes are. Throws Error.
std::shared_ptr<const Texture> read_texture(const std::string& path);

/// A grayscale PNG as a surface of size x, y and height z, centered on the origin. Kept and shared
/// as meshes are.
std::shared_ptr<const HeightGrid> read_heightmap(const std::string& path, const Vec3& size,
                                                 const Source& at);

}  // namespace angen::load

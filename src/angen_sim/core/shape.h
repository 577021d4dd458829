#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/height_grid.h"
#include "core/pose.h"

namespace angen {

/// Triangles in the shape's own frame, meters, already scaled. Counter-clockwise seen from outside.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A solid in its own frame, centered on the origin; a plane passes through it with normal z.
struct Shape {
  enum class Type { kEmpty, kBox, kSphere, kCylinder, kCapsule, kPlane, kMesh, kHeightmap };

  Type type = Type::kEmpty;
  Vec3 size = Vec3::Zero();  // box: full lengths; plane: x and y extents (for display), else unused
  double radius = 0.0;       // sphere, cylinder, capsule
  double length = 0.0;       // cylinder (along z); capsule: of its cylindrical part
  std::shared_ptr<const TriangleMesh> mesh;   // shared between copies
  std::shared_ptr<const HeightGrid> heights;  // a heightmap's, shared between copies
  std::string mesh_file;                      // absolute path a viewer can load
  Vec3 mesh_scale = Vec3::Ones();             // scales mesh_file to `mesh`
};

}  // namespace angen

#pragma once

#include <memory>

#include "core/kept.h"
#include "physics/model.h"

namespace angen::physics {

/// Makes ODE geometries. Triangles are shared between shapes that share their mesh.
class ShapeFactory {
 public:
  /// A geom of the collision's shape, not yet placed; null for an empty shape. Throws Error for a
  /// plane that could move.
  std::unique_ptr<Geom> make(const desc::Collision& collision, const std::string& name,
                             bool dynamic);

 private:
  std::shared_ptr<const MeshData> mesh_data(const std::shared_ptr<const TriangleMesh>& mesh,
                                            bool dynamic);

  Kept<const TriangleMesh*, MeshData> meshes_;
};

/// Moves a geom to its body's pose, and computes its box.
void follow_body(Geom& geom);

}  // namespace angen::physics

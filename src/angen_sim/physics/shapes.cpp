#include "physics/shapes.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/diagnostics.h"
#include "core/lists.h"

namespace angen::physics {

namespace {

using ShapeType = Shape::Type;

dGeomID make_mesh(dTriMeshDataID data) {
  return dCreateTriMesh(nullptr, data, nullptr, nullptr, nullptr);
}

dGeomID make_ode(const Shape& shape, const Geom& geom) {
  switch (shape.type) {
    case ShapeType::kBox:
      return dCreateBox(nullptr, shape.size.x(), shape.size.y(), shape.size.z());
    case ShapeType::kSphere:
      return dCreateSphere(nullptr, shape.radius);
    case ShapeType::kCylinder:
      return dCreateCylinder(nullptr, shape.radius, shape.length);
    case ShapeType::kCapsule:
      return dCreateCapsule(nullptr, shape.radius, shape.length);
    case ShapeType::kPlane:
      return dCreatePlane(nullptr, 0.0, 0.0, 1.0, 0.0);
    case ShapeType::kHeightmap:
      return make_mesh(geom.tiles->bounds());
    default:
      return make_mesh(geom.mesh->data.get());
  }
}

Eigen::Matrix3Xd corners_of(const TriangleMesh& mesh) {
  std::vector<std::array<float, 3>> corners;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      const Eigen::Vector3f& at = mesh.vertices[corner];
      corners.push_back({at.x(), at.y(), at.z()});
    }
  }
  sort_unique(corners);
  const auto count = static_cast<Eigen::Index>(corners.size());
  return Eigen::Map<const Eigen::Matrix3Xf>(corners.front().data(), 3, count).cast<double>();
}

}  // namespace

std::shared_ptr<const MeshData> ShapeFactory::mesh_data(
    const std::shared_ptr<const TriangleMesh>& mesh, bool dynamic) {
  const std::shared_ptr<MeshData> data = meshes_.get(mesh.get(), [&] {
    auto made = std::make_shared<MeshData>();
    made->mesh = mesh;
    made->data.reset(dGeomTriMeshDataCreate());
    dGeomTriMeshDataBuildSingle(made->data.get(), mesh->vertices.data(), sizeof(Eigen::Vector3f),
                                static_cast<int>(mesh->vertices.size()), mesh->triangles.data(),
                                static_cast<int>(3 * mesh->triangles.size()),
                                sizeof(mesh->triangles[0]));
    return made;
  });
  if (dynamic && data->corners.cols() == 0) data->corners = corners_of(*mesh);
  return data;
}

std::unique_ptr<Geom> ShapeFactory::make(const desc::Collision& collision, const std::string& name,
                                         bool dynamic) {
  const Shape& shape = collision.shape;
  if (shape.type == ShapeType::kEmpty) return nullptr;
  if (shape.type == ShapeType::kPlane && dynamic) {
    throw Error(collision.source,
                "collision \"" + name + "\" is a plane on a link that moves, use a box");
  }
  auto geom = std::make_unique<Geom>();
  geom->name = name;
  geom->friction = collision.friction;
  geom->restitution = collision.restitution;
  geom->stiffness = collision.stiffness;
  geom->damping = collision.damping;
  geom->min_depth = collision.min_depth;
  if (shape.type == ShapeType::kBox) geom->thickness = shape.size.minCoeff();
  geom->is_plane = shape.type == ShapeType::kPlane;
  if (shape.type == ShapeType::kMesh) geom->mesh = mesh_data(shape.mesh, dynamic);
  if (shape.type == ShapeType::kHeightmap) {
    geom->tiles = std::make_shared<HeightTiles>(shape.heights);
    geom->tile.reset(make_mesh(geom->tiles->bounds()));
  }
  geom->ode.reset(make_ode(shape, *geom));
  dGeomSetData(geom->ode.get(), geom.get());
  return geom;
}

void follow_body(Geom& geom) {
  const Pose at = geom.body->at * geom.in_body;
  if (geom.is_plane) {
    const Vec3 normal = at.rotation * Vec3::UnitZ();
    dGeomPlaneSetParams(geom.ode.get(), normal.x(), normal.y(), normal.z(),
                        normal.dot(at.position));
  } else {
    ode::set_pose(geom.ode.get(), at);
    if (geom.tile) ode::set_pose(geom.tile.get(), at);
  }
  dReal b[6];
  dGeomGetAABB(geom.ode.get(), b);
  geom.box = {{b[0], b[2], b[4]}, {b[1], b[3], b[5]}};
}

}  // namespace angen::physics

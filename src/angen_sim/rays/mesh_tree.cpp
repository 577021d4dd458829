#include "rays/mesh_tree.h"

#include "rays/query.h"
#include "rays/triangle.h"

namespace angen::rays {
namespace {

struct Corners {
  Vec3 a, b, c;
};

Corners corners(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& t = mesh.triangles[triangle];
  return {mesh.vertices[t[0]].cast<double>(), mesh.vertices[t[1]].cast<double>(),
          mesh.vertices[t[2]].cast<double>()};
}

struct Query {
  RTCIntersectContext context;  // first member: Embree returns its address
  const TriangleMesh* mesh;
  Vec3 origin, direction;
  double min, range;
  std::uint32_t triangle;
};

void box_of_triangle(const RTCBoundsFunctionArguments* args) {
  const auto& mesh = *static_cast<const TriangleMesh*>(args->geometryUserPtr);
  const Corners t = corners(mesh, args->primID);
  Eigen::AlignedBox3d box(t.a);
  *args->bounds_o = padded(box.extend(t.b).extend(t.c));
}

double area_of(const Eigen::AlignedBox3d& box) {
  const Vec3 size = box.sizes();
  return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
}

bool nearer(Query& q, std::uint32_t triangle) {
  double range = 0.0;
  const Corners t = corners(*q.mesh, triangle);
  if (!intersect_triangle(t.a, t.b, t.c, q.origin, q.direction, range)) return false;
  if (range < q.min || range > q.range) return false;
  if (range == q.range && triangle >= q.triangle) return false;
  q.range = range;
  q.triangle = triangle;
  return true;
}

void intersect(const RTCIntersectFunctionNArguments* args) {
  auto& q = *reinterpret_cast<Query*>(args->context);
  if (!args->valid[0] || !nearer(q, args->primID)) return;
  reinterpret_cast<RTCRayHit*>(args->rayhit)->ray.tfar = reach(q.range);
}

}  // namespace

MeshTree::MeshTree(std::shared_ptr<const TriangleMesh> mesh)
    : mesh_(std::move(mesh)), tree_(box_of_triangle, intersect, nullptr) {
  double area = 0.0;
  for (const auto& triangle : mesh_->triangles) {
    Eigen::AlignedBox3d box;
    for (const std::uint32_t corner : triangle) {
      box.extend(mesh_->vertices.at(corner).cast<double>());
    }
    bounds_.extend(box);
    area += area_of(box);
  }
  // The mean projected area of a convex solid is a quarter of its surface.
  if (area > 0.0) crossed_ = area / area_of(bounds_);
  tree_.build(mesh_.get(), mesh_->triangles.size());
}

bool MeshTree::find_hit(const Vec3& origin, const Vec3& direction, double min, double max,
                        double& range, std::uint32_t& triangle) const {
  Query q{};
  rtcInitIntersectContext(&q.context);
  q.mesh = mesh_.get();
  q.origin = origin;
  q.direction = direction;
  q.min = min;
  q.range = max;
  q.triangle = UINT32_MAX;
  RTCRayHit ray{};
  aim(ray.ray, origin, direction, min, max);
  rtcIntersect1(tree_.scene.get(), &q.context, &ray);
  range = q.range;
  triangle = q.triangle;
  return triangle != UINT32_MAX;
}

Vec3 MeshTree::normal(std::uint32_t triangle) const {
  const Corners t = corners(*mesh_, triangle);
  return (t.b - t.a).cross(t.c - t.a).normalized();
}

}  // namespace angen::rays

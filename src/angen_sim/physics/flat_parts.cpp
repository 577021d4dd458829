#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

#include "physics/touching.h"

namespace angen::physics {

namespace {

constexpr double kFace = 0.7;        // least cosine between a contact's normal and its triangle's
constexpr double kOnePlane = 1e-7;   // 1 - cosine between the normals of one plane's triangles
constexpr double kOneHeight = 1e-5;  // m, between those planes where the solid is
constexpr double kDeeper = 1e-3;     // m, more than twice the depth that ODE found is too deep
constexpr double kBeside = 1e-4;     // m, from an edge, where its two triangles are looked for
constexpr double kInside = 1e-6;     // m, that a point may be beyond a triangle's side

struct Triangle {
  int index = -1;
  std::array<Vec3, 3> corners;
  Vec3 normal;  // on the side of the solid

  bool below(const Vec3& point) const {
    for (int i = 0; i < 3; ++i) {
      const Vec3& from = corners[i];
      const Vec3 side = corners[(i + 1) % 3] - from;
      const Vec3 inward = normal.cross(side).normalized();
      const double turn = inward.dot(corners[(i + 2) % 3] - from) < 0.0 ? -1.0 : 1.0;
      if (turn * inward.dot(point - from) < -kInside) return false;
    }
    return true;
  }
};

/// Triangles of one plane, and the contacts with them.
struct FlatPart {
  std::vector<Triangle> triangles;
  std::vector<dContactGeom> on_faces;
  std::vector<dContactGeom> on_edges;

  bool takes(const Triangle& triangle, const Vec3& solid) const {
    const Triangle& own = triangles.front();
    return own.normal.dot(triangle.normal) > 1.0 - kOnePlane &&
           std::abs(own.normal.dot(solid - own.corners[0]) -
                    triangle.normal.dot(solid - triangle.corners[0])) < kOneHeight;
  }
  void add(const Triangle& triangle) {
    const auto is_it = [&](const Triangle& known) { return known.index == triangle.index; };
    if (std::none_of(triangles.begin(), triangles.end(), is_it)) triangles.push_back(triangle);
  }
  /// Whether the mesh has a triangle of the part's plane below a point; those beside its contacts
  /// have none, and a ray finds them.
  bool below(const Vec3& point, dGeomID mesh) const {
    const auto is_below = [&](const Triangle& triangle) { return triangle.below(point); };
    if (std::any_of(triangles.begin(), triangles.end(), is_below)) return true;
    const auto& [index, corners, normal] = triangles.front();
    const Vec3 start = point + (kOneHeight - normal.dot(point - corners[0])) * normal;
    const ode::GeomHandle ray(dCreateRay(nullptr, 2.0 * kOneHeight));
    dGeomRaySet(ray.get(), start.x(), start.y(), start.z(), -normal.x(), -normal.y(), -normal.z());
    dContactGeom hit;
    return ode::collide(ray.get(), mesh, 1, &hit) == 1 &&
           std::abs(normal.dot(ode::vec(hit.normal))) > 1.0 - kOnePlane;
  }
  /// m, that the solid may be below the part: a point much deeper than ODE's hangs below it.
  double most_depth() const {
    double deepest = 0.0;
    for (const auto* points : {&on_faces, &on_edges}) {
      for (const dContactGeom& point : *points) deepest = std::max(deepest, point.depth);
    }
    return 2.0 * deepest + kDeeper;
  }
  /// Whether a contact's edge has triangles of the part's plane on both of its sides.
  bool within(const dContactGeom& point, dGeomID mesh) const {
    const Vec3& up = triangles.front().normal;
    const Vec3 normal = ode::vec(point.normal);
    const Vec3 across = kBeside * (normal - up.dot(normal) * up).normalized();
    const Vec3 at = ode::vec(point.pos);
    return below(at + across, mesh) && below(at - across, mesh);
  }
};

/// The triangle of a contact; false if ODE does not name one, or it has no area.
bool triangle_of(dGeomID mesh, int index, Triangle& out) {
  if (index < 0) return false;
  out.index = index;
  std::array<dVector3, 3> at;
  dGeomTriMeshGetTriangle(mesh, index, &at[0], &at[1], &at[2]);
  for (int i = 0; i < 3; ++i) out.corners[i] = ode::vec(at[i]);
  out.normal = (out.corners[1] - out.corners[0]).cross(out.corners[2] - out.corners[0]);
  if (out.normal.squaredNorm() == 0.0) return false;
  out.normal.normalize();
  return true;
}

/// The contacts that replace the part's.
std::vector<dContactGeom> mended(const FlatPart& part, dGeomID mesh, dGeomID solid,
                                 const OnPlane& on_plane, bool mesh_first) {
  const Triangle& any = part.triangles.front();
  std::array<dContactGeom, kMaxOnPlane> found;
  const std::size_t n = on_plane(any.normal, any.normal.dot(any.corners[0]), found.data());
  const double most_depth = part.most_depth();
  std::vector<dContactGeom> out;
  for (std::size_t i = 0; i < n; ++i) {
    dContactGeom& point = found[i];
    if (point.depth > most_depth || !part.below(ode::vec(point.pos), mesh)) continue;
    point.g1 = mesh_first ? mesh : solid;
    point.g2 = mesh_first ? solid : mesh;
    point.side1 = point.side2 = -1;
    for (int axis = 0; axis < 3; ++axis) point.normal[axis] *= mesh_first ? -1.0 : 1.0;
    out.push_back(point);
  }
  if (!out.empty() && out.size() == n) return out;
  // The solid extends beyond the last triangle, over its edge: ODE reports contacts there.
  std::copy(part.on_faces.begin(), part.on_faces.end(), std::back_inserter(out));
  std::copy_if(part.on_edges.begin(), part.on_edges.end(), std::back_inserter(out),
               [&](const dContactGeom& point) { return !part.within(point, mesh); });
  return out;
}

}  // namespace

std::size_t fix_flat_parts(dGeomID mesh, dGeomID solid, const OnPlane& on_plane, bool mesh_first,
                           dContactGeom* points, std::size_t n, std::size_t most) {
  dReal box[6];
  dGeomGetAABB(solid, box);
  const Vec3 center = Vec3(box[0] + box[1], box[2] + box[3], box[4] + box[5]) / 2.0;
  std::vector<FlatPart> parts;
  std::vector<dContactGeom> out;
  for (std::size_t i = 0; i < n; ++i) {
    const dContactGeom& point = points[i];
    Triangle triangle;
    if (!triangle_of(mesh, mesh_first ? point.side1 : point.side2, triangle)) {
      out.push_back(point);
      continue;
    }
    const double along = triangle.normal.dot(ode::vec(point.normal)) * (mesh_first ? -1.0 : 1.0);
    const bool on_face = std::abs(along) > kFace;
    const double side = on_face ? along : triangle.normal.dot(center - triangle.corners[0]);
    if (side < 0.0) triangle.normal = -triangle.normal;
    auto part = std::find_if(parts.begin(), parts.end(),
                             [&](const FlatPart& p) { return p.takes(triangle, center); });
    if (part == parts.end()) part = parts.insert(part, FlatPart{});
    part->add(triangle);
    (on_face ? part->on_faces : part->on_edges).push_back(point);
  }
  for (const FlatPart& part : parts) {
    const std::vector<dContactGeom> better = mended(part, mesh, solid, on_plane, mesh_first);
    std::copy(better.begin(), better.end(), std::back_inserter(out));
  }
  const std::size_t count = std::min(out.size(), most);
  std::copy_n(out.begin(), count, points);
  return count;
}

}  // namespace angen::physics

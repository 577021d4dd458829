#include "render/bodies.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "rays/query.h"
#include "render/tessellate.h"

namespace angen::render {

namespace {

constexpr float kSeenFrom = 0.5F;  // opacity; glass and the like are invisible
constexpr float kFlat = 1e-5F;     // m off the plane of a quad

Eigen::AlignedBox3d bounds_of(const PlacedHeightmap& heightmap) {
  const Eigen::AlignedBox3d& own = heightmap.tree->bounds();
  const Vec3 center = heightmap.rotation * own.center() + heightmap.position;
  const Vec3 half = heightmap.rotation.cwiseAbs() * own.sizes() / 2;
  return {center - half, center + half};
}

void bound(const RTCBoundsFunctionArguments* args) {
  *args->bounds_o =
      rays::padded(bounds_of(*static_cast<const PlacedHeightmap*>(args->geometryUserPtr)));
}

bool find_hit(const PlacedHeightmap& heightmap, RTCRayN* rays, unsigned count, unsigned i,
              double& range, std::uint32_t& triangle) {
  const Vec3 origin(RTCRayN_org_x(rays, count, i), RTCRayN_org_y(rays, count, i),
                    RTCRayN_org_z(rays, count, i));
  const Vec3 direction(RTCRayN_dir_x(rays, count, i), RTCRayN_dir_y(rays, count, i),
                       RTCRayN_dir_z(rays, count, i));
  const Eigen::Matrix3d back = heightmap.rotation.transpose();
  return heightmap.tree->find_hit(back * (origin - heightmap.position), back * direction,
                                  RTCRayN_tnear(rays, count, i), RTCRayN_tfar(rays, count, i),
                                  range, triangle);
}

void intersect(const RTCIntersectFunctionNArguments* args) {
  const auto& heightmap = *static_cast<const PlacedHeightmap*>(args->geometryUserPtr);
  RTCRayN* rays = RTCRayHitN_RayN(args->rayhit, args->N);
  RTCHitN* hits = RTCRayHitN_HitN(args->rayhit, args->N);
  for (unsigned i = 0; i < args->N; ++i) {
    double range = 0.0;
    std::uint32_t triangle = 0;
    if (args->valid[i] == 0 || !find_hit(heightmap, rays, args->N, i, range, triangle)) continue;
    RTCRayN_tfar(rays, args->N, i) = static_cast<float>(range);
    RTCHitN_primID(hits, args->N, i) = triangle;
    RTCHitN_geomID(hits, args->N, i) = args->geomID;
    RTCHitN_instID(hits, args->N, i, 0) = args->context->instID[0];
  }
}

void occlude(const RTCOccludedFunctionNArguments* args) {
  const auto& heightmap = *static_cast<const PlacedHeightmap*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    double range = 0.0;
    std::uint32_t triangle = 0;
    if (args->valid[i] == 0 || !find_hit(heightmap, args->ray, args->N, i, range, triangle))
      continue;
    RTCRayN_tfar(args->ray, args->N, i) = -std::numeric_limits<float>::infinity();
  }
}

}  // namespace

Patch::Patch(const std::vector<std::pair<const Body*, Pose>>& bodies)
    : scene_(rtcNewScene(rays::device())) {
  for (const auto& [body, pose] : bodies) {
    for (const Surface& surface : body->surfaces) append(surface, pose);
  }
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  attach_triangles();
  attach_heightmaps();
  rtcCommitScene(scene_.get());
  build_faces();
}

void Patch::build_faces() {
  std::vector<Box> boxes;
  const auto corner = [&](std::size_t t, std::size_t i) { return vertices_[triangles_[t][i]]; };
  for (std::uint32_t i = 0; i < triangles_.size();) {
    const bool quad = is_quad(i);
    const Face face{
        {corner(i, 0), corner(i, 1), corner(i, 2), quad ? corner(i + 1, 2) : corner(i, 0)},
        quad ? 4U : 3U};
    Box box;
    for (const Eigen::Vector3f& each : face.corners) box.extend(each);
    boxes.push_back(box);
    face_of_.resize(i + (quad ? 2 : 1), static_cast<std::uint32_t>(faces_.size()));
    faces_.push_back(face);
    first_triangles_.push_back(i);
    i = static_cast<std::uint32_t>(face_of_.size());
  }
  for (const PlacedHeightmap& heightmap : heightmaps_) {
    boxes.push_back(bounds_of(heightmap).cast<float>());
  }
  boxes_.build(boxes);
}

bool Patch::find_in(const Hull& hull, Faces& found) const {
  return each_in(hull, [&](std::uint32_t, const Face& face) {
    if (found.count == found.all.size()) return false;
    found.all[found.count++] = face;
    return true;
  });
}

/// Whether a triangle a b c and the next one, a c d, are a convex quad of one finish.
bool Patch::is_quad(std::size_t triangle) const {
  if (triangle + 1 >= triangles_.size()) return false;
  const auto& first = triangles_[triangle];
  const auto& second = triangles_[triangle + 1];
  const auto at = [&](std::uint32_t i) -> const Eigen::Vector3f& { return vertices_[i]; };
  const Eigen::Vector3f& a = at(first[0]);
  const Eigen::Vector3f &b = at(first[1]), &c = at(first[2]), &d = at(second[2]);
  const Eigen::Vector3f& normal = facets_[triangle].normal;
  return a == at(second[0]) && c == at(second[1]) &&
         facets_[triangle].finish == facets_[triangle + 1].finish &&
         normal.dot(facets_[triangle + 1].normal) > 0.0F && std::abs(normal.dot(d - a)) < kFlat &&
         normal.dot((a - d).cross(b - a)) > 0.0F && normal.dot((c - b).cross(d - c)) > 0.0F;
}

void Patch::attach_triangles() {
  if (triangles_.empty()) return;
  vertices_.emplace_back();  // Embree may read beyond the last one
  const rays::Embree<RTCGeometry> geometry(
      rtcNewGeometry(rays::device(), RTC_GEOMETRY_TYPE_TRIANGLE));
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                             vertices_.data(), 0, sizeof(vertices_[0]), vertices_.size() - 1);
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             triangles_.data(), 0, sizeof(triangles_[0]), triangles_.size());
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(scene_.get(), geometry.get(), 0);
}

void Patch::attach_heightmaps() {
  for (std::size_t i = 0; i < heightmaps_.size(); ++i) {
    const rays::Embree<RTCGeometry> geometry(
        rtcNewGeometry(rays::device(), RTC_GEOMETRY_TYPE_USER));
    rtcSetGeometryUserPrimitiveCount(geometry.get(), 1);
    rtcSetGeometryUserData(geometry.get(), &heightmaps_[i]);
    rtcSetGeometryBoundsFunction(geometry.get(), bound, nullptr);
    rtcSetGeometryIntersectFunction(geometry.get(), intersect);
    rtcSetGeometryOccludedFunction(geometry.get(), occlude);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene_.get(), geometry.get(), static_cast<unsigned>(i + 1));
  }
}

Facet Patch::facet(std::uint32_t geometry, std::uint32_t triangle) const {
  if (geometry == 0) return facets_[triangle];
  const PlacedHeightmap& heightmap = heightmaps_[geometry - 1];
  return {(heightmap.rotation * heightmap.tree->normal(triangle)).cast<float>(), heightmap.finish,
          0};
}

void Patch::append_heightmap(const Surface& surface, const Pose& at) {
  auto tree = rays::TriangleTree::of(surface.shape.heights);
  if (!tree) return;
  heightmaps_.push_back({std::move(tree), at.rotation.normalized().toRotationMatrix(), at.position,
                         static_cast<std::uint32_t>(finishes_.size())});
  finishes_.push_back({surface.color, surface.emissive});  // a texture's mean color
}

void Patch::append(const Surface& surface, const Pose& pose) {
  const Pose at = pose * surface.pose;
  if (surface.shape.type == Shape::Type::kHeightmap) {
    append_heightmap(surface, at);
    return;
  }
  const TriangleMesh mesh = tessellate(surface.shape);
  const Eigen::Matrix3d rotation = at.rotation.normalized().toRotationMatrix();
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    vertices_.push_back((rotation * vertex.cast<double>() + at.position).cast<float>());
  }
  const std::size_t parts = surface.look ? surface.look->parts.size() : 1;
  for (std::size_t part = 0; part < parts; ++part) append_part(surface, mesh, part);
}

// Its vertices are the last ones.
void Patch::append_part(const Surface& surface, const TriangleMesh& mesh, std::size_t part) {
  Finish made{surface.color, surface.emissive};
  std::size_t begin = 0, end = mesh.triangles.size();
  if (surface.look) {
    const std::vector<MeshPart>& parts = surface.look->parts;
    begin = std::min<std::size_t>(parts[part].first, end);
    if (part + 1 < parts.size()) end = std::min<std::size_t>(parts[part + 1].first, end);
    if (parts[part].color.w() < kSeenFrom) return;
    made.color = parts[part].color.head<3>();
  }
  const bool has_corners = !surface.look || !surface.look->corners.empty();
  if (part < surface.textures.size() && has_corners) made.texture = surface.textures[part];
  const auto first = static_cast<std::uint32_t>(vertices_.size() - mesh.vertices.size());
  const auto finish = static_cast<std::uint32_t>(finishes_.size());
  finishes_.push_back(made);
  for (std::size_t i = begin; i < end; ++i) {
    const auto& t = mesh.triangles[i];
    const Eigen::Vector3f& a = vertices_[first + t[0]];
    const Eigen::Vector3f normal = (vertices_[first + t[1]] - a).cross(vertices_[first + t[2]] - a);
    const float length = normal.norm();
    if (!(length > 0.0F) || !std::isfinite(length)) continue;  // slivers are invisible
    triangles_.push_back({first + t[0], first + t[1], first + t[2]});
    facets_.push_back({normal / length, finish, static_cast<std::uint32_t>(corners_.size())});
    if (!made.texture) continue;
    corners_.push_back(surface.look ? surface.look->corners[i]
                                    : wrapped(surface.shape, mesh.vertices[t[0]],
                                              mesh.vertices[t[1]], mesh.vertices[t[2]]));
  }
}

Eigen::Vector3f Patch::color(const Facet& facet, float u, float v) const {
  const Finish& finish = finishes_[facet.finish];
  if (!finish.texture) return finish.color;
  const std::array<float, 6>& at = corners_[facet.corners];
  const float w = 1.0F - u - v;
  return finish.texture->at(w * at[0] + u * at[2] + v * at[4], w * at[1] + u * at[3] + v * at[5]);
}

}  // namespace angen::render

#include "render/bodies.h"

#include "render/tessellate.h"

namespace angen::render {

Patch::Patch(const std::vector<std::pair<const Body*, Pose>>& bodies)
    : scene_(rtcNewScene(rays::device())) {
  for (const auto& [body, pose] : bodies) {
    for (const Surface& surface : body->surfaces) append(surface, pose);
  }
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  if (!triangles_.empty()) {
    vertices_.emplace_back();  // Embree may read a little beyond the last one
    const rays::Embree<RTCGeometry> geometry(
        rtcNewGeometry(rays::device(), RTC_GEOMETRY_TYPE_TRIANGLE));
    rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               vertices_.data(), 0, sizeof(vertices_[0]), vertices_.size() - 1);
    rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               triangles_.data(), 0, sizeof(triangles_[0]), triangles_.size());
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(scene_.get(), geometry.get());
  }
  rtcCommitScene(scene_.get());
}

void Patch::append(const Surface& surface, const Pose& pose) {
  const TriangleMesh mesh = tessellate(surface.shape);
  const Pose at = pose * surface.pose;
  const Eigen::Matrix3d rotation = at.rotation.normalized().toRotationMatrix();
  const auto first = static_cast<std::uint32_t>(vertices_.size());
  const auto finish = static_cast<std::uint32_t>(finishes_.size());
  finishes_.push_back({surface.color, surface.emissive});
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    vertices_.push_back((rotation * vertex.cast<double>() + at.position).cast<float>());
  }
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3f& a = vertices_[first + t[0]];
    const Eigen::Vector3f normal = (vertices_[first + t[1]] - a).cross(vertices_[first + t[2]] - a);
    const float length = normal.norm();
    if (!(length > 0.0F) || !std::isfinite(length)) continue;  // nothing to see of a sliver
    triangles_.push_back({first + t[0], first + t[1], first + t[2]});
    facets_.push_back({normal / length, finish});
  }
}

Stand::Stand() : seen_(rtcNewScene(rays::device())), opaque_(rtcNewScene(rays::device())) {
  for (const RTCScene scene : {seen_.get(), opaque_.get()}) {
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene);
  }
}

std::uint32_t Stand::add(std::unique_ptr<Patch> patch, const Pose& pose, bool throws_shadows) {
  const auto number = static_cast<std::uint32_t>(placed_.size());
  Placed placed;
  placed.instance.reset(rtcNewGeometry(rays::device(), RTC_GEOMETRY_TYPE_INSTANCE));
  rtcSetGeometryInstancedScene(placed.instance.get(), patch->scene());
  placed.patch = std::move(patch);
  placed.shines_through = !throws_shadows;
  rtcAttachGeometryByID(seen_.get(), placed.instance.get(), number);
  if (throws_shadows) rtcAttachGeometryByID(opaque_.get(), placed.instance.get(), number);
  placed_.push_back(std::move(placed));
  place(number, pose);
  return number;
}

void Stand::place(std::uint32_t number, const Pose& pose) {
  Placed& placed = placed_[number];
  Eigen::Matrix<float, 3, 4> transform;
  transform.leftCols<3>() = pose.rotation.normalized().toRotationMatrix().cast<float>();
  transform.col(3) = pose.position.cast<float>();
  placed.rotation = transform.leftCols<3>();
  rtcSetGeometryTransform(placed.instance.get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR,
                          transform.data());
  rtcCommitGeometry(placed.instance.get());
}

void Stand::clear() {
  for (std::uint32_t i = 0; i < placed_.size(); ++i) {
    rtcDetachGeometry(seen_.get(), i);
    if (!placed_[i].shines_through) rtcDetachGeometry(opaque_.get(), i);
  }
  placed_.clear();
}

void Stand::commit() {
  rtcCommitScene(seen_.get());
  rtcCommitScene(opaque_.get());
}

}  // namespace angen::render

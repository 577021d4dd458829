#include "scene/scene.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "ros/convert.h"
#include "rviz/marker_plan.h"
#include "rviz/marker_shapes.h"

namespace angen::node {
namespace {

using angen_msgs::SceneShape;
using visualization_msgs::Marker;

/// Each mesh once, however many shapes have it.
class SceneMeshes {
 public:
  explicit SceneMeshes(std::vector<angen_msgs::SceneMesh>& out) : out_(out) {}

  std::uint32_t of(const TriangleMesh& mesh) {
    const auto [at, is_new] = known_.emplace(&mesh, static_cast<std::uint32_t>(out_.size()));
    if (is_new) {
      angen_msgs::SceneMesh& made = out_.emplace_back();
      for (const Eigen::Vector3f& vertex : mesh.vertices) {
        made.vertices.insert(made.vertices.end(), {vertex.x(), vertex.y(), vertex.z()});
      }
      for (const auto& triangle : mesh.triangles) {
        made.triangles.insert(made.triangles.end(), triangle.begin(), triangle.end());
      }
    }
    return at->second;
  }

  /// The color of a marker's triangles.
  std::uint32_t of(const Marker& list) {
    angen_msgs::SceneMesh& made = out_.emplace_back();
    for (const geometry_msgs::Point& p : list.points) {
      made.triangles.push_back(static_cast<std::uint32_t>(made.triangles.size()));
      made.vertices.insert(made.vertices.end(), {static_cast<float>(p.x), static_cast<float>(p.y),
                                                 static_cast<float>(p.z)});
    }
    return static_cast<std::uint32_t>(out_.size() - 1);
  }

 private:
  std::vector<angen_msgs::SceneMesh>& out_;
  std::map<const TriangleMesh*, std::uint32_t> known_;
};

std_msgs::ColorRGBA color_of(const Eigen::Vector4f& c) { return color(c[0], c[1], c[2], c[3]); }

void add_shapes(const desc::Visual& visual, std::uint32_t link, SceneMeshes& meshes,
                std::vector<SceneShape>& out) {
  SceneShape shape;
  shape.link = link;
  shape.color = color_of(visual.material.diffuse);
  if (visual.shape.type == Shape::Type::kMesh) {  // a viewer need not read the file
    if (visual.shape.mesh == nullptr) return;
    shape.type = SceneShape::MESH;
    shape.mesh = meshes.of(*visual.shape.mesh);
    shape.pose = to_ros(visual.pose);
    out.push_back(std::move(shape));
    return;
  }
  for (const Drawing& drawing : draw(visual)) {
    const Marker& marker = drawing.marker;
    shape.type = marker.type == Marker::SPHERE          ? SceneShape::SPHERE
                 : marker.type == Marker::CYLINDER      ? SceneShape::CYLINDER
                 : marker.type == Marker::TRIANGLE_LIST ? SceneShape::MESH
                                                        : SceneShape::BOX;
    shape.mesh = marker.type == Marker::TRIANGLE_LIST ? meshes.of(marker) : 0;
    shape.pose = to_ros(drawing.offset);
    shape.size = marker.scale;
    out.push_back(shape);
  }
}

angen_msgs::SceneLight light_of(const sim::Structure& structure, const sim::LightEntry& entry) {
  angen_msgs::SceneLight light;
  light.name = entry.name;
  if (entry.model != UINT32_MAX) light.model = structure.models[entry.model]->name;
  light.link = entry.link != UINT32_MAX ? static_cast<std::int32_t>(entry.link) : -1;
  light.directional = entry.light.type == desc::Light::Type::kDirectional;
  light.pose = to_ros(entry.light.pose);
  const Eigen::Vector3f c = entry.light.diffuse;
  light.color = color(c[0], c[1], c[2], 1.0F);
  return light;
}

angen_msgs::SceneSensor field_of(const sim::SensorEntry& entry) {
  const RayGeometry& rays = *entry.rays;
  angen_msgs::SceneSensor sensor;
  sensor.kind = entry.kind;
  sensor.name = entry.name;
  sensor.link = entry.link;
  sensor.pose = to_ros(entry.pose);
  sensor.min_yaw = rays.min_yaw;
  sensor.max_yaw = rays.max_yaw;
  sensor.min_pitch = rays.min_pitch;
  sensor.max_pitch = rays.max_pitch;
  sensor.range = rays.max;
  sensor.rays = static_cast<std::uint32_t>(rays.size());
  return sensor;
}

}  // namespace

angen_msgs::Scene describe_scene(const sim::Structure& structure,
                                 const sim::SharedArray<Pose>& poses) {
  angen_msgs::Scene scene;
  scene.header.frame_id = "world";
  scene.revision = structure.revision;
  SceneMeshes meshes(scene.meshes);
  scene.links.reserve(structure.links.size());
  for (std::uint32_t i = 0; i < structure.links.size(); ++i) {
    const sim::LinkEntry& entry = structure.links[i];
    const desc::Model& model = *structure.models[entry.model];
    angen_msgs::SceneLink& link = scene.links.emplace_back();
    link.model = model.name;
    link.name = model.links[entry.link].name;
    link.group = marker_group(structure, i);
    link.moves = entry.moves;
    link.pose = to_ros(poses[i]);
    for (const desc::Visual& visual : model.links[entry.link].visuals) {
      add_shapes(visual, i, meshes, scene.shapes);
    }
  }
  for (const sim::LightEntry& light : structure.lights) {
    scene.lights.push_back(light_of(structure, light));
  }
  for (const sim::SensorEntry& sensor : structure.sensors) {
    if (sensor.rays != nullptr) scene.sensors.push_back(field_of(sensor));
  }
  return scene;
}

}  // namespace angen::node

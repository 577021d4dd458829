#include "node/scene_message.h"

#include "ros/convert.h"
#include "scene/groups.h"
#include "scene/shapes.h"

namespace angen::node {
namespace {

angen_msgs::SceneMesh mesh_of(const TriangleMesh& mesh) {
  angen_msgs::SceneMesh made;
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    made.vertices.insert(made.vertices.end(), {vertex.x(), vertex.y(), vertex.z()});
  }
  for (const auto& triangle : mesh.triangles) {
    made.triangles.insert(made.triangles.end(), triangle.begin(), triangle.end());
  }
  return made;
}

angen_msgs::SceneShape shape_of(const scene::Shape& shape) {
  angen_msgs::SceneShape made;
  made.type = static_cast<std::uint8_t>(shape.type);
  made.link = shape.link;
  made.mesh = shape.number;
  made.pose = to_ros(shape.pose);
  made.size = to_vector(shape.size);
  made.color = color(shape.color[0], shape.color[1], shape.color[2], shape.color[3]);
  return made;
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

angen_msgs::SceneSensor sensor_of(const sim::SensorEntry& entry, const scene::Field& field) {
  angen_msgs::SceneSensor sensor;
  sensor.kind = entry.kind;
  sensor.name = entry.name;
  sensor.link = entry.link;
  sensor.pose = to_ros(entry.pose);
  sensor.min_yaw = field.min_yaw;
  sensor.max_yaw = field.max_yaw;
  sensor.min_pitch = field.min_pitch;
  sensor.max_pitch = field.max_pitch;
  sensor.range = field.range;
  sensor.rays = field.rays;
  return sensor;
}

}  // namespace

angen_msgs::Scene scene_message(const sim::Structure& structure,
                                const sim::SharedArray<Pose>& poses) {
  angen_msgs::Scene message;
  message.header.frame_id = "world";
  message.revision = structure.revision;
  message.links.reserve(structure.links.size());
  for (std::uint32_t i = 0; i < structure.links.size(); ++i) {
    const sim::LinkEntry& entry = structure.links[i];
    const desc::Model& model = *structure.models[entry.model];
    angen_msgs::SceneLink& link = message.links.emplace_back();
    link.model = model.name;
    link.name = model.links[entry.link].name;
    link.group = scene::group_of(structure, i);
    link.moves = entry.moves;
    link.pose = to_ros(poses[i]);
  }
  for (const sim::LightEntry& light : structure.lights) {
    message.lights.push_back(light_of(structure, light));
  }
  for (const sim::SensorEntry& sensor : structure.sensors) {
    if (const auto field = scene::field_of(sensor)) {
      message.sensors.push_back(sensor_of(sensor, *field));
    }
  }
  const scene::Shapes shapes = scene::shapes_of(structure);
  for (const scene::Shape& shape : shapes.shapes) message.shapes.push_back(shape_of(shape));
  for (const auto& mesh : shapes.meshes) message.meshes.push_back(mesh_of(*mesh));
  return message;
}

}  // namespace angen::node

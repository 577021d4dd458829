#include "py/bindings.h"
#include "py/convert.h"
#include "scene/groups.h"
#include "scene/shapes.h"

namespace angen::py {

namespace {

using pyb::literals::operator""_a;

template <class Vector>
pyb::list numbers(const Vector& vector) {
  pyb::list list;
  for (const double each : vector) list.append(each);
  return list;
}

pyb::list numbers(const Pose& pose) { return numbers(to_row(pose)); }

pyb::dict link_dict(const sim::Snapshot& snapshot, std::uint32_t number) {
  const sim::LinkEntry& entry = snapshot.structure->links[number];
  const desc::Model& model = *snapshot.structure->models[entry.model];
  return pyb::dict("model"_a = model.name, "name"_a = model.links[entry.link].name,
                   "group"_a = scene::group_of(*snapshot.structure, number),
                   "moves"_a = entry.moves, "pose"_a = numbers(snapshot.link_poses[number]));
}

pyb::dict shape_dict(const scene::Shape& shape) {
  return pyb::dict("type"_a = static_cast<int>(shape.type), "link"_a = shape.link,
                   "mesh"_a = shape.number, "pose"_a = numbers(shape.pose),
                   "color"_a = numbers(shape.color), "size"_a = numbers(shape.size));
}

pyb::dict mesh_dict(const TriangleMesh& mesh) {
  return pyb::dict("vertices"_a = pyb::array_t<float>(
                       static_cast<pyb::ssize_t>(3 * mesh.vertices.size()),
                       mesh.vertices.empty() ? nullptr : mesh.vertices.front().data()),
                   "triangles"_a = pyb::array_t<std::uint32_t>(
                       static_cast<pyb::ssize_t>(3 * mesh.triangles.size()),
                       mesh.triangles.empty() ? nullptr : mesh.triangles.front().data()));
}

pyb::dict light_dict(const sim::Structure& structure, const sim::LightEntry& light) {
  Eigen::Vector4f color = Eigen::Vector4f::Ones();
  color.head<3>() = light.light.diffuse;
  const bool lone = light.model == UINT32_MAX;
  return pyb::dict("name"_a = light.name,
                   "model"_a = lone ? std::string() : structure.models[light.model]->name,
                   "link"_a = light.link == UINT32_MAX ? -1 : static_cast<int>(light.link),
                   "sun"_a = light.light.type == desc::Light::Type::kDirectional,
                   "pose"_a = numbers(light.light.pose), "color"_a = numbers(color));
}

pyb::dict sensor_dict(const sim::SensorEntry& sensor, const scene::Field& field) {
  return pyb::dict("kind"_a = sensor.kind, "name"_a = sensor.name, "link"_a = sensor.link,
                   "pose"_a = numbers(sensor.pose),
                   "yaw"_a = pyb::make_tuple(field.min_yaw, field.max_yaw),
                   "pitch"_a = pyb::make_tuple(field.min_pitch, field.max_pitch),
                   "range"_a = field.range, "rays"_a = field.rays);
}

}  // namespace

pyb::dict scene_dict(const sim::Snapshot& snapshot) {
  const sim::Structure& structure = *snapshot.structure;
  const scene::Shapes drawn = scene::shapes_of(structure);
  pyb::list links, shapes, meshes, lights, sensors;
  for (std::uint32_t i = 0; i < structure.links.size(); ++i) links.append(link_dict(snapshot, i));
  for (const scene::Shape& shape : drawn.shapes) shapes.append(shape_dict(shape));
  for (const auto& mesh : drawn.meshes) meshes.append(mesh_dict(*mesh));
  for (const sim::LightEntry& light : structure.lights) {
    lights.append(light_dict(structure, light));
  }
  for (const sim::SensorEntry& sensor : structure.sensors) {
    if (const auto field = scene::field_of(sensor)) sensors.append(sensor_dict(sensor, *field));
  }
  return pyb::dict("revision"_a = structure.revision, "links"_a = links, "shapes"_a = shapes,
                   "meshes"_a = meshes, "lights"_a = lights, "sensors"_a = sensors);
}

}  // namespace angen::py

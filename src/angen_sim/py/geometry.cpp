#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>

#include "core/named.h"
#include "core/text.h"
#include "plugin/ray_geometry.h"
#include "py/bindings.h"
#include "render/tessellate.h"
#include "scene/shapes.h"

namespace angen::py {

namespace {

using Vertices = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

const char* type_name(Shape::Type type) {
  constexpr std::array<const char*, 8> kNames = {"empty",   "box",   "sphere", "cylinder",
                                                 "capsule", "plane", "mesh",   "heightmap"};
  return kNames[static_cast<std::size_t>(type)];
}

Vertices vertices_of(const Shape& shape, const Pose& pose) {
  if (shape.type == Shape::Type::kPlane) return {};
  const TriangleMesh mesh = render::tessellate(shape);
  Vertices all(static_cast<Eigen::Index>(mesh.vertices.size()), 3);
  for (Eigen::Index i = 0; i < all.rows(); ++i)
    all.row(i) = pose * mesh.vertices[static_cast<std::size_t>(i)].cast<double>();
  return all;
}

std::vector<pyb::tuple> shapes(const World& world) {
  const sim::Snapshot& now = world.now();
  const sim::Structure& structure = *now.structure;
  std::vector<pyb::tuple> all;
  for (std::size_t i = 0; i < structure.links.size(); ++i) {
    const sim::LinkEntry& entry = structure.links[i];
    const desc::Model& model = *structure.models[entry.model];
    const desc::Link& link = model.links[entry.link];
    for (const desc::Collision& collision : link.collisions) {
      all.push_back(
          pyb::make_tuple(model.name, link.name, type_name(collision.shape.type), entry.moves,
                          vertices_of(collision.shape, now.link_poses[i] * collision.pose)));
    }
  }
  return all;
}

pyb::dict joint(const World& world, const std::string& name) {
  const sim::Snapshot& now = world.now();
  const sim::Structure& structure = *now.structure;
  const auto found = index_in(structure.joints, name);
  if (!found) throw Error("no joint '" + printable(name) + "'");
  const sim::JointEntry& entry = structure.joints[*found];
  const desc::Model& model = *structure.models[entry.model];
  const desc::Joint& joint = model.joints[entry.joint];
  Pose frame = model.pose;  // at present, as the parent has it
  if (const auto parent = index_in(model.links, joint.parent)) {
    frame = now.link_poses[structure.first_link(entry.model) + *parent] *
            model.links[*parent].pose.inverse();
  }
  pyb::dict dict;
  dict["type"] = joint.type_name();
  dict["model"] = model.name;
  dict["child"] = joint.child;
  dict["anchor"] = Vec3(frame * joint.anchor);
  dict["position"] = now.joint_positions[*found];
  if (!joint.axes.empty()) {
    const desc::JointAxis& axis = joint.axes.front();
    dict["axis"] = Vec3(frame.rotation * axis.xyz);
    dict["limits"] = pyb::make_tuple(axis.lower, axis.upper);
  }
  return dict;
}

pyb::object field_of(const sim::SensorEntry& sensor) {
  const auto field = scene::field_of(sensor);
  if (!field) return pyb::none();
  return pyb::make_tuple(field->min_yaw, field->max_yaw, field->range);
}

using Rows = Eigen::Matrix<double, Eigen::Dynamic, 8, Eigen::RowMajor>;

const sim::SensorEntry& sensor_of(const World& world, const std::string& kind,
                                  const std::string& name) {
  for (const sim::SensorEntry& sensor : world.now().structure->sensors) {
    if (sensor.kind == kind && sensor.name == name) return sensor;
  }
  throw Error("no " + printable(kind) + " named '" + printable(name) + "'");
}

pyb::object detection_rays(const World& world, const std::string& kind, const std::string& name) {
  const sim::SensorEntry& sensor = sensor_of(world, kind, name);
  if (sensor.rays == nullptr) return pyb::none();
  const Pose pose = world.now().link_poses[sensor.link] * sensor.pose;
  const std::vector<Vec3> ways = sensor.rays->detecting();
  Rows rows(static_cast<Eigen::Index>(ways.size()), 8);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    rows.row(i) << pose.position.transpose(),
        (pose.rotation * ways[static_cast<std::size_t>(i)]).transpose(), sensor.rays->min,
        sensor.rays->max;
  }
  return pyb::cast(rows);
}

}  // namespace

void bind_geometry(pyb::class_<World>& world) {
  world
      .def_property_readonly(
          "shapes", &shapes,
          "Shapes of collisions: (model, link, type, moves, vertices). The vertices, (n, 3) in m "
          "in "
          "the world, have the shape as their convex hull, of a mesh as its corners; a plane and a "
          "heightmap have none. Round shapes are within 0.2 % of their radius.")
      .def("joint", &joint, pyb::arg("name"),
           "A model::joint as a dict: type, model, child (a link), position (rad or m), anchor and "
           "axis in the world, limits of its first axis.")
      .def(
          "field_of_view",
          [](const World& w, const std::string& kind, const std::string& name) {
            return field_of(sensor_of(w, kind, name));
          },
          pyb::arg("kind"), pyb::arg("name"),
          "Horizontal limits (rad, left is positive) and range (m) of a sensor's field of view; "
          "None if it has none.")
      .def("detection_rays", &detection_rays, pyb::arg("kind"), pyb::arg("name"),
           "(n, 8) rows of origin, direction, min, max (m, in the world): where a sensor with rays "
           "or zones detects, whatever hides that; a zone has nine. None if it has none.");
}

}  // namespace angen::py

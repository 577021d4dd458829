#include "sdf/geometry.h"

#include <algorithm>

#include "assets/heightmap.h"
#include "assets/mesh.h"
#include "core/limits.h"
#include "core/text.h"
#include "document/search.h"
#include "document/values.h"
#include "document/xml.h"
#include "sdf/surface.h"

namespace angen::load {

namespace {

Vec3 vector_of(const Element& parent, const std::string& name, const Vec3& fallback) {
  const Element* child = parent.child(name);
  if (child == nullptr) return fallback;
  const std::vector<double> v = numbers_of(*child, 3);
  return {v[0], v[1], v[2]};
}

Shape plane(const Element& element, Pose& pose) {
  Shape shape;
  shape.type = Shape::Type::kPlane;
  const Element* size = element.child("size");
  const std::vector<double> v =
      size == nullptr ? std::vector<double>{1.0, 1.0} : numbers_of(*size, 2);
  shape.size = {v[0], v[1], 0.0};
  const Vec3 normal = vector_of(element, "normal", Vec3::UnitZ());
  if (normal.norm() < 1e-9) {
    throw Error(element.source, "the <normal> of this plane has length 0; give 0 0 1");
  }
  pose.rotation =
      (pose.rotation * Quat::FromTwoVectors(Vec3::UnitZ(), normal.normalized())).normalized();
  return shape;
}

PlacedShape mesh(const Element& element, const Pose& pose, Session& session) {
  PlacedShape placed{{}, pose};
  Shape& shape = placed.shape;
  const Element& uri = *element.child("uri");
  shape.mesh_scale = vector_of(element, "scale", Vec3::Ones());
  if (shape.mesh_scale.cwiseAbs().minCoeff() < 1e-12) {
    throw Error(element.child("scale")->source, "a scale of 0 leaves nothing; give 1 1 1");
  }
  try {
    shape.mesh_file = need_uri(uri.text, "mesh", uri.source, session);
  } catch (const Error& error) {
    warn_or_throw_missing(element, error, session);  // nothing stands in its place
    return placed;
  }
  session.sources.will_be_read(shape.mesh_file);
  MeshSource source{shape.mesh_file, shape.mesh_scale};
  if (const Element* part = element.child("submesh")) {
    source.submesh = part->child_text("name");
    source.center = child_flag(*part, "center", false);
    if (source.submesh.empty()) throw Error(part->source, "<submesh> has no <name>; give it one");
  }
  if (const std::string materials = materials_of(source.path); !materials.empty()) {
    source.materials = find_beside(materials, "materials", source.path, uri.source, session);
    if (!source.materials.empty()) session.sources.will_be_read(source.materials);
  }
  ReadMesh file;
  try {
    file = read_mesh(source, uri.source);
  } catch (const Error& error) {
    if (session.guessed) throw;
    session.warn_or_throw(error);
    shape.mesh_file.clear();
    return placed;
  }
  shape.mesh = file.triangles;
  shape.type = Shape::Type::kMesh;
  placed.look = file.look;
  placed.file = source.path;
  if (!source.submesh.empty()) shape.mesh_file.clear();  // a viewer would show all of it
  return placed;
}

Shape heightmap(const Element& element, Pose& pose, Session& session) {
  Shape shape;
  shape.type = Shape::Type::kHeightmap;
  const Element& uri = *element.child("uri");
  const std::string file = need_uri(uri.text, "heightmap", uri.source, session);
  session.sources.will_be_read(file);
  shape.heights = read_heightmap(file, vector_of(element, "size", Vec3::Ones()), uri.source);
  pose.position += pose.rotation * vector_of(element, "pos", Vec3::Zero());
  return shape;
}

// `pose` is turned or moved where SDF says more than Shape does (a plane's normal, a heightmap's
// position).
Shape shape_of(const Element& geometry, Pose& pose, Session& session) {
  const Element& element = geometry.children.at(0);
  Shape shape;
  if (element.name == "plane") return plane(element, pose);
  if (element.name == "heightmap") return heightmap(element, pose, session);
  if (element.name == "box") {
    shape.type = Shape::Type::kBox;
    shape.size = vector_of(element, "size", Vec3::Ones());
    return shape;
  }
  if (element.name == "empty") return shape;
  shape.radius = child_number(element, "radius", 0.0);
  if (element.name == "sphere") {
    shape.type = Shape::Type::kSphere;
    return shape;
  }
  shape.type = element.name == "capsule" ? Shape::Type::kCapsule : Shape::Type::kCylinder;
  shape.length = child_number(element, "length", 0.0);
  return shape;
}

// What a scale or a picture makes of a shape.
void check_size(const Shape& shape, const Element& element) {
  double largest = shape.type == Shape::Type::kBox ? shape.size.maxCoeff() : 0.0;
  if (shape.mesh) {
    for (const Eigen::Vector3f& v : shape.mesh->vertices) {
      largest = std::max<double>(largest, v.cwiseAbs().maxCoeff());
    }
  }
  const std::string problem = limit_problem(limits::kLength, largest);
  if (problem.empty()) return;
  throw Error(element.source,
              "<" + element.name + "> is " + number_text(largest) + " m large; " + problem);
}

}  // namespace

std::vector<PlacedShape> shapes_of(const Element& geometry, const Pose& pose, Session& session) {
  const Element& element = geometry.children.at(0);
  std::vector<PlacedShape> placed;
  if (element.name == "image") {
    placed = image_boxes(element, pose, session);
  } else if (element.name == "mesh") {
    placed.push_back(mesh(element, pose, session));
  } else {
    placed.push_back({{}, pose});
    placed[0].shape = shape_of(geometry, placed[0].pose, session);
  }
  for (PlacedShape& each : placed) {
    try {
      check_size(each.shape, element);
    } catch (const Error& error) {
      if (!each.shape.mesh || session.guessed) throw;
      session.warn_or_throw(error);
      each = {{}, each.pose};
    }
  }
  return placed;
}

}  // namespace angen::load

#include "sdf/geometry.h"

#include <algorithm>
#include <map>

#include "assets/mesh.h"
#include "core/limits.h"
#include "core/text.h"
#include "document/search.h"
#include "document/xml.h"

namespace angen::load {

namespace {

constexpr char kShapes[] =
    "box, capsule, cylinder, empty, heightmap, image, mesh, plane, polyline, "
    "sphere";

Shape plane(const Reader& element, Pose& pose) {
  Shape shape;
  shape.type = Shape::Type::kPlane;
  const std::vector<double> v = element.numbers("size", 2, Range::positive(limits::kNoLimit));
  shape.size = v.empty() ? Vec3(1.0, 1.0, 0.0) : Vec3(v[0], v[1], 0.0);
  const Vec3 normal = element.direction("normal", Vec3::UnitZ());
  if (normal.norm() < 1e-9) {
    throw Error(element.element().source, "the <normal> of this plane has length 0; give 0 0 1");
  }
  pose.rotation =
      (pose.rotation * Quat::FromTwoVectors(Vec3::UnitZ(), normal.normalized())).normalized();
  return shape;
}

PlacedShape mesh(const Reader& element, const Pose& pose, Session& session) {
  PlacedShape placed{{}, pose};
  Shape& shape = placed.shape;
  const Element& uri = element.need("uri");
  const Reader part = element.block("submesh");
  MeshSource source;
  source.submesh = part.text("name");
  source.center = part.flag("center", false);
  shape.mesh_scale = element.vector("scale", Vec3::Ones(), Range::any(limits::kScale));
  if (shape.mesh_scale.cwiseAbs().minCoeff() < 1e-12) {
    throw Error(element.child("scale")->source, "a scale of 0 leaves nothing; give 1 1 1");
  }
  try {
    shape.mesh_file = need_uri(uri.text, "mesh", uri.source, session);
  } catch (const Error& error) {
    session.warn_or_throw(error);  // it has no shape
    return placed;
  }
  source.path = shape.mesh_file;
  source.scale = shape.mesh_scale;
  if (part && source.submesh.empty()) {
    throw Error(part.element().source, "<submesh> has no <name>; give it one");
  }
  if (const std::string materials = materials_of(source.path); !materials.empty()) {
    source.materials = find_beside(materials, "materials", source.path, uri.source, session);
  }
  ReadMesh file;
  try {
    file = read_mesh(source, uri.source);
  } catch (const Error& error) {
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

Shape heightmap(const Reader& element, Pose& pose, Session& session) {
  Shape shape;
  shape.type = Shape::Type::kHeightmap;
  const Element& uri = element.need("uri");
  const Vec3 size = element.need_vector("size", Range::positive(limits::kLength));
  const Vec3 at = element.vector("pos", Vec3::Zero(), Range::any(limits::kPosition));
  const std::string file = need_uri(uri.text, "heightmap", uri.source, session);
  shape.heights = read_heightmap(file, size, uri.source);
  pose.position += pose.rotation * at;
  return shape;
}

// `pose` is turned or moved where SDF says more than Shape does (a plane's normal, a heightmap's
// position).
Shape shape_of(const Reader& element, Pose& pose, Session& session) {
  static const std::map<std::string, Shape::Type> round = {{"sphere", Shape::Type::kSphere},
                                                           {"cylinder", Shape::Type::kCylinder},
                                                           {"capsule", Shape::Type::kCapsule}};
  const std::string& name = element.element().name;
  Shape shape;
  if (name == "empty") return shape;
  if (name == "plane") return plane(element, pose);
  if (name == "heightmap") return heightmap(element, pose, session);
  if (name == "box") {
    shape.type = Shape::Type::kBox;
    shape.size = element.need_vector("size", Range::size());
    return shape;
  }
  const auto type = round.find(name);
  if (type == round.end()) {
    session.warn_or_throw(Error(element.element().source,
                                "unknown shape <" + name + ">; known shapes are " + kShapes));
    return shape;  // none, as a mesh that is missing
  }
  shape.type = type->second;
  shape.radius = element.need_number("radius", Range::size());
  if (shape.type != Shape::Type::kSphere) {
    shape.length = element.need_number("length", Range::size());
  }
  return shape;
}

// A scale or a picture may make a shape too large.
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

/// Null if the <geometry> has none and the dialect permits it.
const Element* shape_in(const Reader& part, Session& session) {
  const Element* geometry = part.child("geometry");
  const Element& element = part.element();
  if (geometry == nullptr) {
    throw Error(element.source, tag_of(element) + " has no <geometry>; give it one, such as <box>");
  }
  for (const Element& shape : geometry->children) {
    const Element& first = geometry->children[0];
    if (&shape == &first || (shape.name == "polyline" && first.name == "polyline")) continue;
    throw Error(shape.source, "a second shape in one <geometry>; keep one");
  }
  if (!geometry->children.empty()) return &geometry->children[0];
  session.warn_or_throw(
      Error(geometry->source, std::string("<geometry> has no shape; known shapes are ") + kShapes));
  return nullptr;
}

}  // namespace

std::vector<PlacedShape> shapes_of(const Reader& part, const Pose& pose, Session& session) {
  const Element* found = shape_in(part, session);
  if (found == nullptr) return {{{}, pose}};
  const Element& element = *found;
  const Reader reader(element, session);
  std::vector<PlacedShape> placed;
  if (element.name == "image") {
    placed = image_boxes(reader, pose, session);
  } else if (element.name == "polyline") {
    placed.push_back({polyline_prism(part.block("geometry"), session), pose});
  } else if (element.name == "mesh") {
    placed.push_back(mesh(reader, pose, session));
  } else {
    placed.push_back({{}, pose});
    placed[0].shape = shape_of(reader, placed[0].pose, session);
  }
  for (PlacedShape& each : placed) {
    try {
      check_size(each.shape, element);
    } catch (const Error& error) {
      if (!each.shape.mesh) throw;
      session.warn_or_throw(error);
      each = {{}, each.pose};
    }
  }
  return placed;
}

}  // namespace angen::load

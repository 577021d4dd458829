#include "scene/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/text.h"

namespace angen::scene {
namespace {

constexpr double kThin = 0.002;     // m, a plane's slab
constexpr double kEndless = 100.0;  // m, a plane without a size
constexpr double kLeast = 1e-4;     // m

Part sized(Part::Type type, const Vec3& size, const Pose& pose = {}) {
  return {type, pose, size.cwiseMax(kLeast)};
}

// A message holds three points a triangle: the grid is thinned to that many columns and rows.
std::shared_ptr<const TriangleMesh> thinned(const HeightGrid& grid) {
  constexpr std::uint32_t kMaxCells = 128;
  const auto mesh = std::make_shared<TriangleMesh>();
  const std::uint32_t across = std::min(kMaxCells, grid.columns - 1);
  const std::uint32_t down = std::min(kMaxCells, grid.rows - 1);
  const auto add = [&](std::uint32_t column, std::uint32_t row) {
    mesh->vertices.push_back(
        grid.vertex(column * (grid.columns - 1) / across, row * (grid.rows - 1) / down));
    return static_cast<std::uint32_t>(mesh->vertices.size() - 1);
  };
  const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh->triangles.push_back({a, b, c});
  };
  for (std::uint32_t row = 0; row < down; ++row) {
    for (std::uint32_t column = 0; column < across; ++column) {
      const std::uint32_t first = add(column, row);
      triangle(first, add(column, row + 1), add(column + 1, row));
      const std::uint32_t second = add(column + 1, row);
      triangle(second, add(column, row + 1), add(column + 1, row + 1));
    }
  }
  return mesh;
}

std::vector<Part> parts_of(const angen::Shape& shape) {
  const double width = 2 * shape.radius;
  switch (shape.type) {
    case angen::Shape::Type::kEmpty:
      break;
    case angen::Shape::Type::kBox:
      return {sized(Part::Type::kBox, shape.size)};
    case angen::Shape::Type::kSphere:
      return {sized(Part::Type::kSphere, Vec3::Constant(width))};
    case angen::Shape::Type::kCylinder:
      return {sized(Part::Type::kCylinder, {width, width, shape.length})};
    case angen::Shape::Type::kCapsule: {
      std::vector<Part> parts{sized(Part::Type::kCylinder, {width, width, shape.length})};
      for (const double end : {-0.5, 0.5}) {
        parts.push_back(sized(Part::Type::kSphere, Vec3::Constant(width),
                              {Vec3(0, 0, end * shape.length), Quat::Identity()}));
      }
      return parts;
    }
    case angen::Shape::Type::kPlane: {
      const double x = shape.size.x() > 0 ? shape.size.x() : kEndless;
      const double y = shape.size.y() > 0 ? shape.size.y() : kEndless;
      return {sized(Part::Type::kBox, {x, y, kThin}, {Vec3(0, 0, -kThin / 2), Quat::Identity()})};
    }
    case angen::Shape::Type::kMesh:
      if (shape.mesh_file.empty() && shape.mesh == nullptr) break;
      return {{Part::Type::kMesh, {}, Vec3::Zero(), shape.mesh}};
    case angen::Shape::Type::kHeightmap:
      if (shape.heights == nullptr) break;
      return {{Part::Type::kMesh, {}, Vec3::Zero(), thinned(*shape.heights)}};
  }
  return {};
}

}  // namespace

std::vector<Part> parts_of(const desc::Visual& visual) {
  std::vector<Part> parts = parts_of(visual.shape);
  for (Part& part : parts) part.pose = visual.pose * part.pose;
  return parts;
}

Shapes shapes_of(const sim::Structure& structure) {
  Shapes all;
  std::map<std::shared_ptr<const TriangleMesh>, std::uint32_t> known;
  const auto add = [&](const desc::Visual& visual, std::uint32_t link) {
    for (Part& part : parts_of(visual)) {
      if (part.type == Part::Type::kMesh && part.mesh == nullptr) continue;
      Shape& shape = all.shapes.emplace_back();
      static_cast<Part&>(shape) = std::move(part);
      shape.link = link;
      shape.color = visual.material.diffuse;
      if (shape.mesh == nullptr) continue;
      const auto [at, is_new] =
          known.emplace(shape.mesh, static_cast<std::uint32_t>(all.meshes.size()));
      if (is_new) all.meshes.push_back(shape.mesh);
      shape.number = at->second;
    }
  };
  for (std::uint32_t i = 0; i < structure.links.size(); ++i) {
    for (const desc::Visual& visual : structure.described(structure.links[i]).visuals) {
      add(visual, i);
    }
  }
  return all;
}

std::optional<Field> field_of(const sim::SensorEntry& sensor) {
  if (sensor.rays != nullptr) {
    const RayGeometry& rays = *sensor.rays;
    return Field{rays.min_yaw,   rays.max_yaw, rays.min_pitch,
                 rays.max_pitch, rays.max,     static_cast<std::uint32_t>(rays.size())};
  }
  const Element* camera = sensor.desc ? sensor.desc->element.child("camera") : nullptr;
  if (camera == nullptr || camera->child("horizontal_fov") == nullptr) return std::nullopt;
  const double half = parse_number(camera->child_text("horizontal_fov")).value_or(0.0) / 2;
  const Element* image = camera->child("image");
  const auto pixels = [&](const char* name, double usual) {
    return image == nullptr ? usual : parse_number(image->child_text(name)).value_or(usual);
  };
  const double high = std::atan(std::tan(half) * pixels("height", 240.0) / pixels("width", 320.0));
  return Field{-half, half, -high, high, std::numeric_limits<double>::infinity(), 0};
}

}  // namespace angen::scene

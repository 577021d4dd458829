#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "desc/world.h"
#include "sim/snapshot.h"

/// Descriptions as the few shapes that each viewer can draw, and fields of view of sensors.
namespace angen::scene {

/// A part of a visual, in the frame of its link.
struct Part {
  enum class Type : std::uint8_t { kBox, kSphere, kCylinder, kMesh };  // numbers of SceneShape.msg

  Type type = Type::kBox;
  Pose pose;
  Vec3 size = Vec3::Zero();  // m: lengths; diameters; diameters and length along z; not of a kMesh
  std::shared_ptr<const TriangleMesh> mesh{};  // a kMesh has one; null: its file has not been read
};

/// The parts of a visual: one, three of a capsule, none of an empty shape.
std::vector<Part> parts_of(const desc::Visual& visual);

struct Shape : Part {
  std::uint32_t link = 0;    // in Structure::links
  std::uint32_t number = 0;  // its mesh in Shapes::meshes
  Eigen::Vector4f color = Eigen::Vector4f::Zero();
};

/// All shapes of a structure; a mesh is in the list once, however many have it.
struct Shapes {
  std::vector<Shape> shapes;
  std::vector<std::shared_ptr<const TriangleMesh>> meshes;
};

Shapes shapes_of(const sim::Structure& structure);

/// The field of view of a sensor, in its own frame.
struct Field {
  double min_yaw = 0.0;  // rad, positive to the left
  double max_yaw = 0.0;
  double min_pitch = 0.0;  // rad, positive upwards
  double max_pitch = 0.0;
  double range = 0.0;      // m; infinite of a camera
  std::uint32_t rays = 0;  // 0 of a camera
};

/// The field of a sensor with rays or of a camera; none of others.
std::optional<Field> field_of(const sim::SensorEntry& sensor);

}  // namespace angen::scene

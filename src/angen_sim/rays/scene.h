#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "core/id.h"
#include "core/shape.h"

/// Shapes in two bounding hierarchies, and rays cast against them.
namespace angen::rays {

using ShapeId = Id<struct RayShapeTag>;

struct Ray {
  Vec3 origin = Vec3::Zero();      // m, world frame
  Vec3 direction = Vec3::UnitX();  // unit (a range counts its lengths)
  double min = 0.0;                // m; nearer surfaces are not seen
  double max = std::numeric_limits<double>::infinity();
};

struct Hit {
  double range = std::numeric_limits<double>::infinity();  // m, infinite where nothing is met
  std::uint32_t shape = UINT32_MAX;                        // index of the ShapeId met
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();        // unit, towards the ray's origin

  bool hit() const { return shape != UINT32_MAX; }
};

enum class Mobility { kStatic, kMoving };

/// A shape whose surface has a temperature of its own; all others are as warm as the air.
struct WarmShape {
  std::uint32_t shape = UINT32_MAX;  // index of its ShapeId, as in Hit
  double temperature = 0.0;          // K
  Eigen::AlignedBox3d box;           // m, world, around it
};

class Scene {
 public:
  Scene();
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Reflectance is the diffuse albedo (r g b, 0..1) that `light` uses. Empty shapes are never met.
  ShapeId add(const Shape& shape, const Pose& pose, Mobility mobility,
              const Eigen::Vector3f& reflectance);
  /// Gives a shape that is not empty a surface temperature in K.
  void warm(ShapeId shape, double temperature);
  void move(ShapeId shape, const Pose& pose);
  void remove(ShapeId shape);

  /// Makes additions, moves and removals visible to casts. Cheap when nothing changed.
  void commit();

  /// Nearest hits; hits[i] answers rays[i]. Surfaces are met from both sides; a ray that starts
  /// inside a shape meets its far side; planes are infinite. Where several lie at bit-equal range,
  /// static shapes come before moving ones and then the lowest index wins. A ray that is not finite
  /// or has no direction meets nothing. Requires commit() since the last change. Casts may run in
  /// several threads at once.
  void cast(const Ray* rays, Hit* hits, std::size_t count) const;
  void cast(const std::vector<Ray>& rays, std::vector<Hit>& hits) const;

  /// True when anything lies on the segment (both ends shortened by `margin` m).
  bool blocked(const Vec3& from, const Vec3& to, double margin = 1e-4) const;

  Eigen::Vector3f reflectance(std::uint32_t shape_index) const;
  /// In the order in which they were warmed, as of the last commit().
  const std::vector<WarmShape>& warm_shapes() const;

  /// Counts commits that changed something: equal revisions mean equal answers.
  std::uint64_t revision() const;
  std::uint64_t static_revision() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace angen::rays

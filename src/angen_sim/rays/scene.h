#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
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

/// The part of a straight line that runs inside a shape; `enter` and `leave` are equal for a plane.
struct Crossing {
  double enter = 0.0;                                // m from the line's start
  double leave = 0.0;                                // m
  std::uint32_t shape = UINT32_MAX;                  // index of its ShapeId
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // unit, of the surface that it enters by, or
                                                     // leaves by where it starts inside
};

/// Anchored: stands until it moves, as a door does, or a chair that nobody pushes.
enum class Mobility { kStatic, kAnchored, kMoving };

/// Which mobilities a cast meets.
using Mobilities = unsigned;
constexpr Mobilities only(Mobility mobility) { return 1U << static_cast<unsigned>(mobility); }
constexpr Mobilities kAll = 7U;

/// A shape's place, and its box in its own frame; a plane's is infinite along x and y.
struct Placement {
  Shape::Type type = Shape::Type::kEmpty;
  Pose pose;
  Eigen::AlignedBox3d box;
};

/// A shape whose surface has a temperature of its own; all others are as warm as the air.
struct WarmShape {
  std::uint32_t shape = UINT32_MAX;  // index of its ShapeId, as in Hit
  double temperature = 0.0;          // K
  Eigen::AlignedBox3d box;           // m, world, around it
};

/// A static or anchored shape that casts may meet.
struct Standing {
  ShapeId id;
  bool is_static = false;
  Eigen::AlignedBox3d box;  // m, world; infinite for a plane
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
  /// Gives a shape that is not empty a surface temperature in K, or another one.
  void warm(ShapeId shape, double temperature);
  void move(ShapeId shape, const Pose& pose);
  /// Makes an anchored shape a moving one, or the other way round.
  void set_anchored(ShapeId shape, bool anchored);
  void remove(ShapeId shape);

  /// Makes additions, moves and removals visible to casts. Cheap when nothing changed.
  void commit();

  /// Nearest hits; hits[i] answers rays[i]. Surfaces are met from both sides; a ray that starts
  /// inside a shape meets its far side; planes are infinite. Where several lie at bit-equal range,
  /// static shapes come before moving ones and then the lowest index wins. A ray that is not finite
  /// or has no direction meets nothing. Requires commit() since the last change. Casts may run in
  /// several threads at once.
  void cast(const Ray* rays, Hit* hits, std::size_t count, Mobilities among = kAll) const;
  void cast(const std::vector<Ray>& rays, std::vector<Hit>& hits) const;

  /// Takes into account one more moving shape than `hit` does. A cast() among the static
  /// ones bettered by every moving shape on the ray's way, in any order, is bit for bit what cast()
  /// gives. Needs no commit().
  void better(ShapeId moving, const Ray& ray, Hit& hit) const;

  /// World box (m) around a shape: infinite for a plane, empty for what is never met.
  Eigen::AlignedBox3d bounds(ShapeId shape) const;

  /// True when anything lies on the segment (both ends shortened by `margin` m).
  bool blocked(const Vec3& from, const Vec3& to, double margin = 1e-4,
               Mobilities among = kAll) const;

  /// What lies on the segment, all shapes, in the order in which it enters them. Requires commit().
  std::vector<Crossing> crossings(const Vec3& from, const Vec3& to) const;

  /// The nearest hit on one shape alone.
  Hit cast_at(std::uint32_t shape_index, const Ray& ray) const;
  /// Whether a static or anchored solid other than `except` has the point inside; meshes and planes
  /// have none.
  bool covered(const Vec3& point, std::uint32_t except) const;

  Eigen::Vector3f reflectance(std::uint32_t shape_index) const;
  /// In the order in which they were first warmed, as of the last commit().
  const std::vector<WarmShape>& warm_shapes() const;
  /// Counts commits after which warm_shapes() have other temperatures.
  std::uint64_t warm_revision() const;

  Mobility mobility(std::uint32_t shape_index) const;
  Placement placement(std::uint32_t shape_index) const;

  /// Around all static shapes but planes, world frame.
  Eigen::AlignedBox3d static_bounds() const;
  /// What stands at an index of a ShapeId; none where nothing does.
  std::optional<Standing> standing(std::uint32_t index) const;
  /// Ascending indices of all that came, went or moved among what stands, or may have, since the
  /// call that left `mark`; with a mark of 0 all there ever were. Leaves a new mark.
  std::vector<std::uint32_t> standing_changes(std::uint64_t& mark) const;

  /// Counts commits that changed something: equal revisions mean equal answers.
  std::uint64_t revision() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace angen::rays

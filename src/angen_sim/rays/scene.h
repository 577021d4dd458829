#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/id.h"
#include "core/shape.h"
#include "core/warming.h"

/// Shapes in two bounding hierarchies, and rays cast against them.
namespace angen::rays {

using ShapeId = Id<struct RayShapeTag>;

struct Ray {
  Vec3 origin = Vec3::Zero();      // m, world frame
  Vec3 direction = Vec3::UnitX();  // unit; ranges are multiples of its length
  double min = 0.0;                // m; nearer surfaces are not hit
  double max = std::numeric_limits<double>::infinity();
};

struct Hit {
  double range = std::numeric_limits<double>::infinity();  // m, infinite without a hit
  std::uint32_t shape = UINT32_MAX;                        // index of its ShapeId
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();        // unit, towards the ray's origin

  bool hit() const { return shape != UINT32_MAX; }
};

/// The part of a segment inside a shape; `enter` and `leave` are equal for a plane.
struct Crossing {
  double enter = 0.0;                                // m from the segment's start
  double leave = 0.0;                                // m
  std::uint32_t shape = UINT32_MAX;                  // index of its ShapeId
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // unit, at `enter`, or at `leave` if inside
};

/// Anchored: can move, but counts as standing until it does, such as a door or a chair at rest.
enum class Mobility { kStatic, kAnchored, kMoving };

/// A set of mobilities, such as those that a cast can hit.
using Mobilities = unsigned;
constexpr Mobilities only(Mobility mobility) { return 1U << static_cast<unsigned>(mobility); }
constexpr Mobilities kAll = 7U;

/// A shape's pose in the world, and its box in its own frame (m), infinite along x and y for a
/// plane.
struct Placement {
  Shape::Type type = Shape::Type::kEmpty;
  Pose pose;
  Eigen::AlignedBox3d box;
};

/// A shape with its own surface temperature; all others have the temperature of the air.
struct WarmShape {
  std::uint32_t shape = UINT32_MAX;                        // index of its ShapeId, as in Hit
  Warming course;                                          // its temperature
  Eigen::AlignedBox3d box;                                 // m, world, around it
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // own frame to world
};

/// A static or anchored shape that casts may hit.
struct Standing {
  ShapeId id;
  bool is_static = false;
  Eigen::AlignedBox3d box;  // m, world; infinite for a plane
};

class Shaft;
class Nearby;

class Scene {
 public:
  Scene();
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Reflectance is the diffuse albedo (r g b, 0..1) that `light` uses. Empty shapes are never hit.
  ShapeId add(const Shape& shape, const Pose& pose, Mobility mobility,
              const Eigen::Vector3f& reflectance);
  /// How the surface temperature of a shape changes from now on; ignores empty shapes.
  void warm(ShapeId shape, const Warming& course);
  void move(ShapeId shape, const Pose& pose);
  /// Makes a movable shape anchored or moving; ignores static shapes.
  void set_anchored(ShapeId shape, bool anchored);
  /// Whether casts may hit a shape from now on; a hidden one is as an empty one.
  void show(ShapeId shape, bool shown);
  bool is_hidden(ShapeId shape) const;
  void remove(ShapeId shape);

  /// Makes additions, moves and removals visible to casts. Cheap when nothing changed.
  void commit();

  /// Nearest hits; hits[i] is that of rays[i]. Surfaces are hit from both sides; a ray that starts
  /// inside a shape hits its far side; planes are infinite. At bit-equal range, static shapes come
  /// before movable ones, then the lowest index wins. A ray that is not finite or has no direction
  /// hits nothing. Requires commit() since the last change. Several threads may call it at once.
  void cast(const Ray* rays, Hit* hits, std::size_t count, Mobilities among = kAll) const;
  void cast(const std::vector<Ray>& rays, std::vector<Hit>& hits, Mobilities among = kAll) const;

  /// Replaces `hit` if the movable shape is nearer. A cast() among static shapes, followed by this
  /// for every movable shape on the ray's way, in any order, equals a cast() among all bit for bit.
  /// Needs no commit().
  void better(ShapeId moving, const Ray& ray, Hit& hit) const;

  /// Box (m, world) around a shape: infinite for a plane, empty for a shape that is never hit.
  Eigen::AlignedBox3d bounds(ShapeId shape) const;

  /// Whether a shape is on the segment (m, world), which `margin` (m) shortens at both ends.
  /// Requires commit().
  bool blocked(const Vec3& from, const Vec3& to, double margin = 1e-4,
               Mobilities among = kAll) const;

  /// All shapes on the segment (m, world), in the order in which it enters them. Requires commit().
  std::vector<Crossing> crossings(const Vec3& from, const Vec3& to, Mobilities among = kAll) const;

  /// For many rays from one point (m, world) to one shape, of which none hits anything nearer than
  /// `near` (m). A shape that reaches less than 2 mm into the other's box, as a floor does with
  /// things on it, counts as beside it. Requires commit().
  Shaft shaft(const Vec3& from, double near, std::uint32_t shape_index) const;
  /// Whether one shape would block all rays of that shaft, as Shaft::blocked_by() finds it among
  /// all; false if that shape is gone. Requires commit().
  bool blocks(std::uint32_t by_index, const Vec3& from, double near,
              std::uint32_t shape_index) const;

  /// The present moment for moved_since().
  std::uint64_t moment() const;
  /// Whether a shape came, went or moved in the box (m, world) since that moment; also true if that
  /// was too long ago to know.
  bool moved_since(std::uint64_t moment, const Eigen::AlignedBox3d& box) const;

  /// The nearest hit on one shape; ignores all others.
  Hit cast_at(std::uint32_t shape_index, const Ray& ray) const;
  /// Whether a static or anchored solid other than `except` contains the point (m, world), or is
  /// within 0.2 mm of it; meshes and planes contain none.
  bool covered(const Vec3& point, std::uint32_t except) const;

  /// The cost of a ray from the point (m, world) among static and anchored shapes, in ordinary
  /// rays: more than 1 where boxes of many shapes contain it, or those of meshes that cross
  /// themselves. Requires commit().
  std::int64_t price(const Vec3& point) const;

  /// A scene of the standing shapes as they are now, with the same indices, for light. It can be
  /// queried while this one changes.
  std::shared_ptr<const Scene> standing_scene() const;
  /// For many queries of standing shapes within the box (m, world).
  Nearby near(const Eigen::AlignedBox3d& box) const;

  Eigen::Vector3f reflectance(std::uint32_t shape_index) const;
  /// In the order in which they were first warmed, as of the last commit().
  const std::vector<WarmShape>& warm_shapes() const;

  Mobility mobility(std::uint32_t shape_index) const;
  Placement placement(std::uint32_t shape_index) const;

  /// Box (m, world) around all static shapes except planes.
  Eigen::AlignedBox3d static_bounds() const;
  /// The standing shape at the index of a ShapeId, if there is one.
  std::optional<Standing> standing(std::uint32_t index) const;
  /// Ascending indices of standing shapes that have, or may have, been added, removed or moved
  /// since the call that set `mark`; for a mark of 0, all indices ever used. Sets a new mark.
  std::vector<std::uint32_t> standing_changes(std::uint64_t& mark) const;

  /// Counts commits that changed something: equal revisions mean equal answers.
  std::uint64_t revision() const;
  /// The same of static shapes alone; that of two scenes differs, unless both have none.
  std::uint64_t static_revision() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace angen::rays

#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <mutex>
#include <vector>

#include "rays/device.h"
#include "rays/scene.h"
#include "rays/shaft.h"
#include "rays/solid.h"

namespace angen::rays {

/// One ray, and the nearest hit found.
struct SceneQuery {
  RTCIntersectContext context;  // first member: Embree returns its address
  Vec3 origin, direction;
  double length2;  // square of the direction's length
  double min;
  Intersection best;   // range starts at the ray's max
  std::uint64_t rank;  // rank of the nearest hit; the lower wins a tie
  const Solid* solid;
  Mobilities among;  // the shapes that it can hit

  /// False for a ray that cannot hit anything: not finite, without direction, with an empty
  /// interval.
  bool prepare(const Vec3& from, const Vec3& towards, double nearest, double farthest,
               Mobilities among);
  /// From one point to another, without `margin` (m) at both.
  bool prepare_between(const Vec3& from, const Vec3& to, double margin, Mobilities among) {
    const double length = (to - from).norm();
    return prepare(from, (to - from) / length, margin, length - margin, among);
  }
  bool prepare(const Ray& ray, Mobilities among) {
    return prepare(ray.origin, ray.direction, ray.min, ray.max, among);
  }

  /// Static shapes before moving ones, then by index.
  static std::uint64_t rank_of(std::uint32_t slot, bool fixed) {
    return (fixed ? 0ULL : 1ULL << 32) | slot;
  }

  bool wants(const Solid& candidate, bool fixed) const {
    return (among & only(mobility_of(candidate, fixed))) != 0;
  }

  /// The mobility of a solid in a fixed layer or in another one. A fixed one can contain anchored
  /// solids, which do not move while it exists.
  static Mobility mobility_of(const Solid& solid, bool fixed) {
    if (solid.anchored) return Mobility::kAnchored;
    return fixed ? Mobility::kStatic : Mobility::kMoving;
  }

  bool try_solid(const Solid& candidate, bool fixed);

  Hit hit() const;
};

constexpr std::int64_t kTenths = 10;  // tenths of the time of an ordinary ray

/// Changes of a layer, ascending: none, places of a few moving shapes, of many, any other.
enum class Changed { kNothing, kFewMoved, kMoved, kAny };

/// The static shapes or the movable ones: bounded shapes in a hierarchy, and planes, which have no
/// box. A few shapes that have moved since the hierarchy was built are tested one by one: people
/// walk in each sample, and a hierarchy of all shapes costs more than some thousand rays.
class Layer {
 public:
  explicit Layer(bool fixed);

  std::vector<Solid> bounded;
  std::vector<Solid> planes;
  bool fixed;
  Mobilities held;

  void change(Changed changed) { changed_ = std::max(changed_, changed); }
  /// A moving shape, at this place in `bounded`, has another pose.
  void move(std::uint32_t at);
  bool changed() const { return changed_ != Changed::kNothing; }
  /// Makes the changes visible to the next query.
  void commit();

  std::vector<Solid>& list(Shape::Type type) {
    return type == Shape::Type::kPlane ? planes : bounded;
  }

  /// Whether it may contain shapes of these mobilities.
  bool holds(Mobilities among) const { return (among & held) != 0; }

  /// Rebuilds the hierarchy if queries among these depend on the changes. Several threads may call
  /// it.
  void prepare(Mobilities among) const;
  /// Replaces the query's best hit by a nearer one of this layer. Requires prepare().
  void nearest(SceneQuery& q) const;
  /// Whether the ray hits a shape of this layer. Requires prepare().
  bool any(SceneQuery& q) const;
  /// Calls visit() for each shape that may have a part in the hull. Requires prepare().
  void find_in(const ShaftHull& hull, const std::function<void(const Solid&)>& visit) const;
  /// Calls visit() for each bounded shape whose box intersects the box (m, world). Requires
  /// prepare().
  void find_near(const Eigen::AlignedBox3d& box,
                 const std::function<void(const Solid&)>& visit) const;
  /// Whether a bounded static or anchored solid other than `except` contains the point (m, world).
  /// Requires prepare().
  bool covers(const Vec3& point, std::uint32_t except) const;
  /// Tenths of the time of an ordinary ray to test a ray from the point (m, world) against the
  /// static and anchored shapes whose boxes contain it. Requires prepare().
  std::int64_t crowd(const Vec3& point) const;

 private:
  Changed changed_ = Changed::kNothing;                      // since the last commit()
  mutable std::atomic<Changed> unbuilt_{Changed::kNothing};  // committed since it was built
  mutable std::mutex building_;
  mutable Hierarchy tree_;
  mutable std::vector<std::uint32_t> loose_;  // places of these in `bounded`
};

}  // namespace angen::rays

#pragma once

#include <algorithm>
#include <atomic>
#include <mutex>
#include <vector>

#include "rays/device.h"
#include "rays/scene.h"
#include "rays/solid.h"

namespace angen::rays {

/// One ray, and the nearest of what it has met so far.
struct SceneQuery {
  RTCIntersectContext context;  // first: Embree hands back its address
  Vec3 origin, direction;
  double min;
  Meeting best;        // range starts at the ray's max
  std::uint64_t rank;  // of the best so far; the lower wins a tie
  const Solid* solid;
  bool anchored, moving;  // which of those that can move are met

  /// False for a ray that meets nothing by definition: not finite, no direction, an empty interval.
  bool prepare(const Vec3& from, const Vec3& towards, double nearest, double farthest,
               Mobilities among);
  bool prepare(const Ray& ray, Mobilities among) {
    return prepare(ray.origin, ray.direction, ray.min, ray.max, among);
  }

  /// Static shapes before moving ones, then by index.
  static std::uint64_t rank_of(std::uint32_t slot, bool fixed) {
    return (fixed ? 0ULL : 1ULL << 32) | slot;
  }

  bool wants(const Solid& candidate, bool fixed) const {
    return fixed || (candidate.anchored ? anchored : moving);
  }

  bool try_solid(const Solid& candidate, bool fixed);

  Hit hit() const;
};

/// What has changed of a layer, the lesser first: places of moving shapes; anything else.
enum class Changed { kNothing, kMoved, kAny };

/// The shapes that stand, or those that can move: those with a box in a hierarchy, planes (which
/// have none) beside it.
class Layer {
 public:
  explicit Layer(bool fixed);

  std::vector<Solid> bounded;
  std::vector<Solid> planes;
  bool fixed;

  void change(Changed changed) { changed_ = std::max(changed_, changed); }
  bool changed() const { return changed_ != Changed::kNothing; }
  /// The next query takes the changes into account.
  void commit();

  std::vector<Solid>& list(Shape::Type type) {
    return type == Shape::Type::kPlane ? planes : bounded;
  }

  /// Whether it may hold any of these.
  bool holds(Mobilities among) const {
    constexpr Mobilities kStanding = only(Mobility::kStatic);
    return (among & (fixed ? kStanding : kAll & ~kStanding)) != 0;
  }

  /// Rebuilds the hierarchy where queries among these would miss what has changed. Queries may come
  /// from several threads.
  void prepare(Mobilities among) const;
  /// Takes into account what lies nearer here than the best so far. Requires prepare().
  void nearest(SceneQuery& q) const;
  /// Whether the ray meets anything here. Requires prepare().
  bool any(SceneQuery& q) const;
  /// Whether a static or anchored solid with a box, other than `except`, has the point inside.
  /// Requires prepare().
  bool covers(const Vec3& point, std::uint32_t except) const;

 private:
  Changed changed_ = Changed::kNothing;                      // since the last commit()
  mutable std::atomic<Changed> unbuilt_{Changed::kNothing};  // until then, since it was built
  mutable std::mutex building_;
  mutable Hierarchy tree_;
};

}  // namespace angen::rays

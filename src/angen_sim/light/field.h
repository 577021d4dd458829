#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "light/reflected_light.h"
#include "light/surfaces.h"

namespace angen::light {

// SDF's white is 1, with which reflections would never end; white paint reflects at most this.
constexpr float kLargestAlbedo = 0.9F;

using Rgb = Eigen::Array4f;  // r g b and one unused, for SIMD

Rgb albedo(const rays::Scene& scene, std::uint32_t shape);

/// Follows the standing shapes of a scene that changes.
class Changes {
 public:
  using Box = Eigen::AlignedBox3d;
  struct Change {
    Box box;  // m, world: around a shape's old and new place
    bool is_static = false;
  };
  struct Moved {
    std::uint32_t shape = 0;
    Box box;  // m, world: around all its places
  };

  /// Returns where standing shapes were added, removed or moved since the last call.
  std::vector<Change> follow(const rays::Scene& scene);
  /// Whether the box (m, world) has a change since the last take().
  bool any_in(const Box& box) const;
  bool any() const { return !outdated_.empty(); }  // since the last take()
  /// Returns the changed shapes, by index, and counts them as known.
  std::vector<Moved> take();

 private:
  using Known = std::optional<rays::Standing>;

  void compare(std::uint32_t shape, const Known& now, bool is_static, std::vector<Change>& changes);
  void note(std::uint32_t shape, const Box& box, bool is_static, std::vector<Change>& changes);

  std::vector<Known> known_;             // by shape, as of the last follow()
  std::uint64_t followed_ = 0;           // the scene's mark of changes then
  std::vector<std::uint32_t> outdated_;  // shapes that have changed since the last take()
  std::vector<Box> been_;                // by shape: old and new boxes of those of `outdated_`
};

/// The patches of a scene of standing shapes, and which of them each one sees: found by rays when
/// they are first asked for, and again only where a shape was added, removed or moved. A copy
/// shares what is known.
class Field {
 public:
  using Box = Eigen::AlignedBox3d;
  struct Link {
    std::uint32_t patch = kNoPatch;
    float range = 0.0F;     // m, to the hit
    float exchange = 0.0F;  // m^2, its share of form factor times area
    bool is_rare = false;   // counts for the way back too
  };

  Field() : surfaces_(std::make_shared<const rays::Scene>()) {}

  const rays::Scene& scene() const { return surfaces_.scene(); }

  /// Continues with another scene, in which these shapes differ: patches near them are made again
  /// when a ray hits them, and links past them are cast again. All is then as if found now.
  void update(std::shared_ptr<const rays::Scene> scene, const std::vector<Changes::Moved>& moved);
  /// Differs after each update of any field.
  std::uint64_t revision() const { return revision_; }

  std::uint32_t patch_at(std::uint32_t shape, const Vec3& point, const Vec3& normal) {
    return surfaces_.at(shape, point, normal);
  }
  const Patch& operator[](std::uint32_t patch) const { return surfaces_[patch]; }
  /// Whether the number is still that of this patch.
  bool holds(std::uint32_t patch, std::uint64_t serial) const {
    return surfaces_.alive(patch) && surfaces_[patch].serial == serial;
  }
  /// The patches that one sees.
  const std::vector<Link>& links(std::uint32_t patch);
  Link link_of(const rays::Ray& ray, const rays::Hit& hit);
  std::uint64_t forgotten() const { return surfaces_.forgotten(); }  // patches since the start
  Rgb albedo_of(std::uint32_t patch) const;

  /// The patches whose `light` (lx, by patch) is more than 0.
  std::vector<ReflectedLight::Piece> pieces(const std::vector<Rgb>& light) const;
  std::size_t size() const { return surfaces_.size(); }  // one more than the highest patch

 private:
  struct Sight {  // what a patch sees
    std::vector<Link> links;
    Box reach;  // m, world, around them
  };

  void weigh(std::uint32_t patch, Link& link) const;
  Box forget_near(const Box& box, std::vector<std::uint32_t>& gone);
  void cast_again(std::uint32_t patch, const std::vector<Box>& changed);

  Surfaces surfaces_;
  std::vector<std::shared_ptr<const Sight>> sights_;  // by patch; null until asked for
  std::uint64_t revision_ = 0;
};

/// Whether a ray passes the box (m, world) before that range, m.
bool passes(const Eigen::AlignedBox3d& box, const rays::Ray& ray, double range);

}  // namespace angen::light

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "light/reflected_light.h"
#include "light/surfaces.h"

namespace angen::light {

// SDF's white is 1, with which reflections would never end; white paint reflects at most this.
constexpr float kLargestAlbedo = 0.9F;

using Rgb = Eigen::Array4f;  // r g b and one unused, for SIMD

/// The patches of a scene, and which of them each one sees: found by rays when they are first
/// asked for, and again only where a standing shape was added, removed or moved.
class Field {
 public:
  struct Link {
    std::uint32_t patch = kNoPatch;
    float range = 0.0F;  // m, to the hit
  };
  struct Change {
    Eigen::AlignedBox3d box;  // m, world: around a shape's old and new place
    bool is_static = false;
  };

  explicit Field(const rays::Scene& scene) : scene_(scene), surfaces_(scene) {}

  const rays::Scene& scene() const { return scene_; }

  /// Returns where standing shapes were added, removed or moved since the last call.
  std::vector<Change> follow();
  /// Whether the box (m, world) has a change that update() has not processed.
  bool outdated_in(const Eigen::AlignedBox3d& box) const;
  /// Processes the changes that follow() has found: patches near them are made again when a ray
  /// hits them, and links past them are cast again. All is then as if it was found now.
  void update();
  std::uint64_t revision() const { return revision_; }  // counts updates

  std::uint32_t patch_at(std::uint32_t shape, const Vec3& point, const Vec3& normal) {
    return surfaces_.at(shape, point, normal);
  }
  const Patch& operator[](std::uint32_t patch) const { return surfaces_[patch]; }
  /// The patches that one sees.
  const std::vector<Link>& links(std::uint32_t patch);
  Link link_of(const rays::Ray& ray, const rays::Hit& hit);
  std::uint64_t forgotten() const { return surfaces_.forgotten(); }  // patches since the start
  Rgb albedo(std::uint32_t shape) const;
  Rgb albedo_of(std::uint32_t patch) const;

  /// The patches whose `light` (lx, by patch) is more than 0.
  std::vector<ReflectedLight::Piece> pieces(const std::vector<Rgb>& light) const;
  std::size_t size() const { return surfaces_.size(); }  // one more than the highest patch

 private:
  using Box = Eigen::AlignedBox3d;
  using Known = std::optional<rays::Standing>;
  struct Sight {  // what a patch sees
    Sight() = default;
    // noexcept, so that a growing vector moves it: the move of Eigen's box is not declared so.
    Sight(Sight&&) noexcept = default;
    Sight& operator=(Sight&&) noexcept = default;

    std::vector<Link> links;  // none until they are asked for
    Box reach;                // m, world, around them
  };

  void compare(std::uint32_t shape, const Known& now, bool is_static, std::vector<Change>& changes);
  void note(std::uint32_t shape, const Box& box, bool is_static, std::vector<Change>& changes);
  void forget_near(const Box& box, std::vector<std::uint32_t>& gone);
  void cast_again(std::uint32_t patch, const std::vector<Box>& changed);

  const rays::Scene& scene_;
  Surfaces surfaces_;
  std::vector<Sight> sights_;   // by patch
  std::vector<Known> known_;    // by shape, as of the last follow()
  std::uint64_t followed_ = 0;  // the scene's mark of changes then
  std::uint64_t revision_ = 0;
  std::vector<std::uint32_t> outdated_;  // shapes that have changed since the last update
  std::vector<Box> been_;                // by shape: old and new boxes of those of `outdated_`
};

}  // namespace angen::light

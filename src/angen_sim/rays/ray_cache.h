#pragma once

#include <vector>

#include "rays/scene.h"

namespace angen::rays {

/// Caches the hits of fixed rays on static shapes; cast() then tests nearby movers against those
/// rays only that may hit one. Settled movers may be cached, too. Its hits are bit for bit those of
/// Scene::cast.
class RayCache {
 public:
  /// Calls measure(); the scene must be committed.
  RayCache(std::vector<Ray> rays, const Scene& scene);

  /// Casts the rays again, after static shapes were added, removed or moved. The scene must be
  /// committed.
  void measure(const Scene& scene);

  /// Box (m, world) around the rays up to their static hits: a mover whose box does not overlap it
  /// changes no hit. Infinite if a ray has no end.
  const Eigen::AlignedBox3d& reach() const { return reach_; }

  std::size_t size() const { return rays_.size(); }

  /// Caches hits on these movers instead of those cached before. Must be called again when one of
  /// them has been moved or removed, and after measure().
  void settle(const Scene& scene, const std::vector<ShapeId>& movers);

  /// hits[i] is that of ray i. `movers` must contain every mover whose box overlaps reach(), except
  /// settled ones, each once. Returns whether any of them is hit.
  bool cast(const Scene& scene, const std::vector<ShapeId>& movers, Hit* hits) const;

 private:
  // Four rays as floats, to find quickly which of them may meet a box.
  struct Packet {
    Eigen::Array4f origin[3];
    Eigen::Array4f inverse[3];  // inverse of the direction
    Eigen::Array4f range;
  };

  void pack();
  void clip(const std::vector<Hit>& hits);
  bool cast_against(const Scene& scene, const std::vector<ShapeId>& movers, Hit* hits) const;
  bool cast_mover(const Scene& scene, ShapeId mover, const Eigen::AlignedBox3d& box,
                  Hit* hits) const;

  std::vector<Ray> rays_;
  std::vector<Hit> fixed_;    // on static shapes
  std::vector<Hit> settled_;  // on these and settled movers; empty if no settled one is hit
  std::vector<Packet> packets_;
  Eigen::AlignedBox3d reach_;
};

}  // namespace angen::rays

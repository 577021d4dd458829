#pragma once

#include <vector>

#include "rays/scene.h"

namespace angen::rays {

/// Rays that stay where they are. Their hits on static shapes are cached; cast() then takes the
/// movers that are near and casts only those rays that may hit one. Movers that stand still may be
/// added to the cache, too. Its hits are bit for bit those of Scene::cast.
class RayCache {
 public:
  /// Measures; the scene must be committed.
  RayCache(std::vector<Ray> rays, const Scene& scene);

  /// The same rays anew, after static shapes came, went or moved. The scene must be committed.
  void measure(const Scene& scene);

  /// The box (world, m) in which the rays run, up to what stops them: a mover whose box does not
  /// overlap it changes no hit. Infinite where a ray ends nowhere.
  const Eigen::AlignedBox3d& reach() const { return reach_; }

  std::size_t size() const { return rays_.size(); }

  /// Caches hits on these movers, and on none cached before, for each cast() until one of them
  /// moves or goes; then, and after measure(), it is to be called anew.
  void settle(const Scene& scene, const std::vector<ShapeId>& movers);

  /// hits[i] answers ray i. `movers` must hold every moving shape whose box overlaps reach() but
  /// those that have been settled, each once. Returns whether any of them is met.
  bool cast(const Scene& scene, const std::vector<ShapeId>& movers, Hit* hits) const;

 private:
  // Four rays as floats, to find quickly which of them may meet a box.
  struct Packet {
    Eigen::Array4f origin[3];
    Eigen::Array4f inverse[3];  // of the direction
    Eigen::Array4f range;
  };

  void pack();
  void clip(const std::vector<Hit>& hits);
  bool cast_against(const Scene& scene, const std::vector<ShapeId>& movers, Hit* hits) const;
  bool cast_mover(const Scene& scene, ShapeId mover, const Eigen::AlignedBox3d& box,
                  Hit* hits) const;

  std::vector<Ray> rays_;
  std::vector<Hit> fixed_;    // of static shapes
  std::vector<Hit> settled_;  // of these and settled movers; empty where none of those is met
  std::vector<Packet> packets_;
  Eigen::AlignedBox3d reach_;
};

}  // namespace angen::rays

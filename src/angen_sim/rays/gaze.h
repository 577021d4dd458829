#pragma once

#include <vector>

#include "rays/scene.h"

namespace angen::rays {

/// Rays that stay where they are. What they meet of the static shapes is measured once; a look then
/// takes in the movers that it is told of, and casts only those rays that may meet one. Its hits
/// are bit for bit those of Scene::cast.
class Gaze {
 public:
  /// Measures; the scene must be committed.
  Gaze(std::vector<Ray> rays, const Scene& scene);

  /// The same rays anew, after static shapes came, went or moved. The scene must be committed.
  void measure(const Scene& scene);

  /// The box (world, m) in which the rays run, up to what stops them: a mover whose box does not
  /// overlap it changes no hit. Infinite where a ray ends nowhere.
  const Eigen::AlignedBox3d& reach() const { return reach_; }

  std::size_t size() const { return rays_.size(); }

  /// hits[i] answers ray i. `movers` must hold every moving shape whose box overlaps reach(), each
  /// once. Returns whether any of them is met.
  bool look(const Scene& scene, const std::vector<ShapeId>& movers, Hit* hits) const;

 private:
  // Four rays as floats, to tell quickly which of them may meet a box.
  struct Packet {
    Eigen::Array4f origin[3];
    Eigen::Array4f inverse[3];  // of the direction
    Eigen::Array4f range;
  };

  void pack();
  bool take_in(const Scene& scene, ShapeId mover, const Eigen::AlignedBox3d& box, Hit* hits) const;

  std::vector<Ray> rays_;
  std::vector<Hit> fixed_;  // of static shapes
  std::vector<Packet> packets_;
  Eigen::AlignedBox3d reach_;
};

}  // namespace angen::rays

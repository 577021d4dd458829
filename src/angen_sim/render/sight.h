#pragma once

#include <array>
#include <vector>

#include "light/lamp.h"
#include "render/instances.h"
#include "render/tracer.h"

namespace angen::render {

/// Free rays from some points to a lamp.
enum class Sight { kNone, kAll, kSome };

/// Answers for all points of a box at once: kSome where that is not certain. Boxes are divided into
/// parts, and these again: each level starts from the faces that are in the way at the level above.
/// Answers for earlier boxes make later ones faster, and do not change them. One for each thread.
class Sights {
 public:
  Sights(const Instances& instances, const std::vector<light::Lit>& lamps)
      : instances_(instances), lamps_(lamps), last_(lamps.size()) {}

  /// From points that are lifted off their surfaces: on level 0, or a part of the box of the last
  /// answer on the level above, if that was kSome.
  Sight of(std::size_t lamp, std::size_t level, const Box& points);
  /// What may hide the lamp from some of the points of the last answer on that level, if it was
  /// kSome.
  const Obstacles& obstacles(std::size_t level) const { return obstacles_[level]; }

 private:
  Hull hull_of(std::size_t lamp, const Box& points) const;
  bool hides(std::size_t lamp, const Hull& rays, const Eigen::Vector3f& from,
             const Eigen::Vector3f& to, bool& is_free);
  Sight found(std::size_t lamp, const Box& points, Obstacles& obstacles);
  Sight narrowed(const Hull& rays, const Obstacles& from, Obstacles& obstacles) const;

  const Instances& instances_;
  const std::vector<light::Lit>& lamps_;
  std::vector<Face> last_;                           // for each lamp: the face that hid it last
  std::array<Obstacles, kDivisions + 1> obstacles_;  // between the last box and its lamp, by level
};

}  // namespace angen::render

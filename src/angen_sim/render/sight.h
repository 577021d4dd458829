#pragma once

#include <vector>

#include "light/lamp.h"
#include "render/instances.h"

namespace angen::render {

/// Which rays from some points to a lamp are free.
enum class Sight { kNone, kAll, kSome };

/// Answers for all points of a box at once: kSome where that is not certain. Answers of the last
/// box make the next ones faster, and do not change them. One for each thread.
class Sights {
 public:
  Sights(const Instances& instances, const std::vector<light::Lit>& lamps)
      : instances_(instances), lamps_(lamps), last_(lamps.size()) {}

  /// From points that are lifted off their surfaces.
  Sight of(std::size_t lamp, const Box& points);
  /// The same for some of the points of the last box, if its answer was kSome.
  Sight of_part(std::size_t lamp, const Box& points);
  /// The bodies that may hide the lamp from some points of the last part, if its answer was kSome.
  const Among& among() const { return among_; }

 private:
  Hull hull_of(std::size_t lamp, const Box& points) const;
  bool hides(std::size_t lamp, const Hull& rays, const Eigen::Vector3f& from,
             const Eigen::Vector3f& to, bool& is_free);

  const Instances& instances_;
  const std::vector<light::Lit>& lamps_;
  std::vector<Face> last_;  // for each lamp: the face that hid it last
  Obstacles obstacles_;     // between the last box and its lamp
  Among among_;
};

}  // namespace angen::render

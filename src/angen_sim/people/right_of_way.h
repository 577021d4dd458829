#pragma once

#include <optional>
#include <vector>

#include "people/floor_map.h"
#include "people/surroundings.h"
#include "plugin/plugin.h"

namespace angen::people {

/// A part of a way that is too narrow for two, from where it begins to where it ends; it may bend.
class Passage {
 public:
  using Vec2 = Surroundings::Vec2;

  struct Place {
    Vec2 at;          // m, in its middle
    Vec2 along;       // unit, of the way
    double on = 0.0;  // m from where it begins
  };
  /// Where somebody is in it or before it.
  struct Foot {
    double on = 0.0;     // m from where it begins, along it
    double aside = 0.0;  // m to the left
    Vec2 along = Vec2::UnitX();
  };

  void add(const Vec2& at, const Vec2& along);
  const Place& begin() const { return places_.front(); }
  const Place& end() const { return places_.back(); }
  double length() const { return end().on; }
  Foot foot(const Vec2& at) const;
  bool holds(const Vec2& at) const;
  /// The place so far (m) from where it begins, or before that.
  Vec2 place_at(double on) const;
  /// Whether a point is no farther than `reach` (m) from its middle line.
  bool is_near(const Vec2& point, double reach) const;

 private:
  std::vector<Place> places_;
};

/// The narrow parts of a way on a map, in their order; the way's places are a cell or two apart.
std::vector<Passage> passages_of(const FloorMap& map, const std::vector<Surroundings::Vec2>& way);

/// Whether a person at `feet` (world, m) may walk on to the next narrow part of its way: through
/// one that others come out of nobody goes in, and who is nearest to it goes first. Of those who
/// meet in it the fewer walk back. Returns where it waits beside the way, `beside` if it waits
/// there already, or where it walks back to; none: it may go.
std::optional<Surroundings::Vec2> place_to_wait(const View& view, const Vec3& feet,
                                                const std::vector<Passage>& passages,
                                                const std::optional<Surroundings::Vec2>& beside);

/// Whether people nearby are still on their way, and may leave room.
bool have_others_to_go(const View& view, const Vec3& feet);

}  // namespace angen::people

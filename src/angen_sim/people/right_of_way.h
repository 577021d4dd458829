#pragma once

#include <optional>
#include <vector>

#include "people/floor_map.h"
#include "people/surroundings.h"
#include "plugin/plugin.h"

namespace angen::people {

/// A part of a way that is too narrow for two, m: from where it begins to where it ends.
struct Passage {
  Surroundings::Vec2 enter = Surroundings::Vec2::Zero();
  Surroundings::Vec2 leave = Surroundings::Vec2::Zero();
  Surroundings::Vec2 along = Surroundings::Vec2::UnitX();  // unit, of the way through it
};

/// The narrow parts of a way on a map, in their order; the way's places are a cell or two apart.
std::vector<Passage> passages_of(const FloorMap& map, const std::vector<Surroundings::Vec2>& way);

/// Whether a person at `feet` (world, m) may walk on to the next narrow part of its way: through
/// one that others come out of nobody goes in, and who is nearest to it goes first. Returns where
/// it waits beside the way, `beside` if it waits there already; none: it may go.
std::optional<Surroundings::Vec2> place_to_wait(const View& view, const Vec3& feet,
                                                const std::vector<Passage>& passages,
                                                const std::optional<Surroundings::Vec2>& beside);

/// Whether people nearby are still on their way, and may leave room.
bool have_others_to_go(const View& view, const Vec3& feet);

}  // namespace angen::people

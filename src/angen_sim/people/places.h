#pragma once

#include <optional>
#include <string>

#include "people/surroundings.h"
#include "plugin/command.h"
#include "plugin/plugin.h"

namespace angen::people {

/// A place to go to.
struct Goal {
  Surroundings::Vec2 to = Surroundings::Vec2::Zero();  // m, world
  std::optional<int> floor;  // a storey's number; none: that of the person
};

/// The goal of a command to a person at `feet` (world, m), or why it is none: a place outside of
/// the world, a floor that does not exist or that no elevator serves, or an unknown name.
struct Found {
  Goal goal;
  std::string why_not;  // empty: there is a goal
};
Found find_goal(const Command& command, const View& view, const Vec3& feet);

}  // namespace angen::people

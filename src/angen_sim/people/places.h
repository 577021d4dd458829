#pragma once

#include <functional>
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
/// Why a person at `feet` cannot get to a floor: it does not exist, or no elevator serves it.
std::string unserved(int floor, const Home& home, const Vec3& feet);
Found find_goal(const Command& command, const View& view, const Vec3& feet);

/// Whether two names differ at most in upper and lower case.
bool is_same(const std::string& a, const std::string& b);

/// The best place, by `rate`, in a box on a floor for a person to fit in; the first if several are
/// equal. A place rated 0 is never chosen.
std::optional<Surroundings::Vec2> best_place(
    const View& view, const Eigen::AlignedBox2d& box, double floor,
    const std::function<double(const Surroundings::Vec2&)>& rate);

}  // namespace angen::people

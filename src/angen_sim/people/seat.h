#pragma once

#include <optional>
#include <string>

#include "people/modes.h"
#include "people/surroundings.h"
#include "plugin/command.h"
#include "plugin/plugin.h"

namespace angen::people {

/// Where a person sits or lies, and where it gets up to.
struct Seat {
  Posture posture = Posture::kSit;
  Pose at;                    // world, of the seat, or of the middle of who lies, head ahead
  Vec3 stand = Vec3::Zero();  // m, world: its feet before it sat down
};

/// The seat of a command Sit or Lie to a person whose body would stand at `body` (world). It is a
/// free seat or bed within reach, or for Lie the floor below the person. If there is none,
/// `why_not` says why.
struct FoundSeat {
  std::optional<Seat> seat;
  std::string why_not;
};
FoundSeat find_seat(const Command& command, const View& view, const Pose& body);

/// The place on the floor of `to` (world, m) nearest to that where a person has room, not behind a
/// wall; none within `reach` (m).
std::optional<Vec3> free_place_beside(const View& view, const Vec3& to, double reach);

/// Where it stands when it gets up; none while others leave no room.
std::optional<Vec3> place_to_stand(const View& view, const Seat& seat);

}  // namespace angen::people

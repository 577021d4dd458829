#pragma once

#include <string_view>
#include <vector>

#include "core/home.h"

namespace angen {

class View;
struct DeviceView;

/// The rooms of one climate: those that its model describes, in their order. It is valid as long as
/// the view's home.
struct RoomPlan {
  static constexpr int kOutside = -1;

  const Home& home;
  std::vector<const Room*> rooms;

  /// The room that a point in the world is in, or kOutside. A point in a wall is in the room.
  int at(const Vec3& point) const;
  int named(const std::string& name) const;
};

RoomPlan room_plan(const View& view, std::string_view model);

/// Whether the model that describes a room has a climate.
bool has_climate(const View& view, const Room& room);

/// The climates of the world, in the order in which they came into it.
std::vector<DeviceView> climates(const View& view);

/// A doorway or window: the rooms on its two sides, and how far it is open.
struct RoomOpening {
  int first = RoomPlan::kOutside;
  int second = RoomPlan::kOutside;
  double gap = 0.0;     // m, free width
  double width = 0.0;   // m, of the leaf
  double height = 0.0;  // m
};

/// The openings between rooms of a plan, or to the outside: those whose leaf, a device whose state
/// has a `gap`, is in a model in `within`, and then those without a leaf.
std::vector<RoomOpening> room_openings(const View& view, const RoomPlan& plan,
                                       const Eigen::AlignedBox3d& within);

struct AirHere {
  double temperature = 0.0;  // degrees Celsius
  double humidity = 0.0;     // percent
};

/// The air at a point in the world: its room's, or outside of all rooms that outside. Not a number
/// where the world has no climate.
AirHere air_at(const View& view, const Vec3& point);

/// K, of the air at a point; that of the world where it has no climate.
double air_temperature(const View& view, const Vec3& point);

}  // namespace angen

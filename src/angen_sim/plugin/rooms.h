#pragma once

#include <vector>

#include "plugin/view.h"

namespace angen {

/// The rooms of one climate as its state has them: boxes in the frame of its model.
struct RoomPlan {
  static constexpr int kOutside = -1;

  Pose frame;  // world
  std::vector<Eigen::AlignedBox3d> rooms;

  /// The room that a point in the world is in, or kOutside. A point in a wall is in the room.
  int at(const Vec3& point) const;
};

/// The rooms of a climate's state.
RoomPlan room_plan(const DeviceView& climate);

/// The climates of the world, in the order in which they came into it.
std::vector<DeviceView> climates(const View& view);

/// A doorway or window: the rooms on its two sides, and how far its leaf is open.
struct RoomOpening {
  int first = RoomPlan::kOutside;
  int second = RoomPlan::kOutside;
  double gap = 0.0;     // m, free width
  double width = 0.0;   // m, of the leaf
  double height = 0.0;  // m
};

/// The opening that a leaf stands in. `leaf` is a device whose state has a `gap`; its model's
/// origin is on the hinge at the opening's foot, x along the shut leaf.
RoomOpening room_opening(const DeviceView& leaf, const RoomPlan& plan);

struct AirHere {
  double temperature = 0.0;  // degrees Celsius
  double humidity = 0.0;     // percent
};

/// The air at a point in the world: its room's, or outside of all rooms that outside. Not a number
/// where the world has no climate.
AirHere air_at(const View& view, const Vec3& point);

}  // namespace angen

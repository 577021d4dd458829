#include "plugin/rooms.h"

#include <limits>
#include <string>

namespace angen {

namespace {

constexpr double kInWall = 0.05;  // m: a thing in a wall is in the room
constexpr double kBesides = 0.4;  // m from the middle of an opening to the air on either side

}  // namespace

int RoomPlan::at(const Vec3& point) const {
  const Vec3 local = frame.inverse() * point;
  const Vec3 margin = Vec3::Constant(kInWall);
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    const Eigen::AlignedBox3d wide(rooms[i].min() - margin, rooms[i].max() + margin);
    if (wide.contains(local)) return static_cast<int>(i);
  }
  return kOutside;
}

RoomPlan room_plan(const DeviceView& climate) {
  RoomPlan plan{climate.pose, {}};
  const auto numbers = climate.state.get<std::vector<double>>("rooms");
  for (std::size_t i = 0; i + 6 <= numbers.size(); i += 6) {
    plan.rooms.emplace_back(Vec3::Map(&numbers[i]), Vec3::Map(&numbers[i + 3]));
  }
  return plan;
}

std::vector<DeviceView> climates(const View& view) {
  std::vector<DeviceView> found;
  for (const DeviceView& device : view.devices("rooms")) {
    if (device.kind == "climate") found.push_back(device);
  }
  return found;
}

RoomOpening room_opening(const DeviceView& leaf, const RoomPlan& plan) {
  RoomOpening opening;
  opening.gap = leaf.state.get<double>("gap");
  opening.width = leaf.state.get<double>("width");
  opening.height = leaf.state.get<double>("height");
  const Vec3 middle(0.5 * opening.width, 0.0, 0.5 * opening.height);
  const Vec3 aside(0.0, kBesides, 0.0);
  opening.first = plan.at(leaf.pose * Vec3(middle + aside));
  opening.second = plan.at(leaf.pose * Vec3(middle - aside));
  return opening;
}

AirHere air_at(const View& view, const Vec3& point) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  AirHere outside{kNone, kNone};
  for (const DeviceView& climate : climates(view)) {
    const auto temperatures = climate.state.get<std::vector<double>>("temperatures");
    const auto humidities = climate.state.get<std::vector<double>>("humidities");
    const int room = room_plan(climate).at(point);
    if (room != RoomPlan::kOutside) {
      const auto i = static_cast<std::size_t>(room);
      return {temperatures.at(i), humidities.at(i)};
    }
    outside = {climate.state.get<double>("outside_temperature"),
               climate.state.get<double>("outside_humidity")};
  }
  return outside;
}

}  // namespace angen

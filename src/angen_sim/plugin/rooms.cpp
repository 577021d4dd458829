#include "plugin/rooms.h"

#include <cmath>
#include <limits>
#include <string>

#include "core/named.h"
#include "plugin/view.h"

namespace angen {

int RoomPlan::at(const Vec3& point) const {
  const Room* room = home.room_at(point);
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    if (rooms[i] == room) return static_cast<int>(i);
  }
  return kOutside;
}

int RoomPlan::named(const std::string& name) const {
  const auto index = index_in(rooms, name);
  return index ? static_cast<int>(*index) : kOutside;
}

RoomPlan room_plan(const View& view, std::string_view model) {
  RoomPlan plan{view.home(), {}};
  for (const Room& room : plan.home.rooms) {
    if (room.model == model) plan.rooms.push_back(&room);
  }
  return plan;
}

std::vector<DeviceView> climates(const View& view) {
  std::vector<DeviceView> found;
  for (const DeviceView& device : view.devices("outside_humidity")) {
    if (device.kind == "climate") found.push_back(device);
  }
  return found;
}

std::vector<RoomOpening> room_openings(const View& view, const RoomPlan& plan,
                                       const Eigen::AlignedBox3d& within) {
  std::vector<RoomOpening> openings;
  const auto add = [&](const HomeDoor& door, double gap, double width, double height) {
    const RoomOpening opening{plan.named(door.rooms[0]), plan.named(door.rooms[1]), gap, width,
                              height};
    if (opening.first != opening.second) openings.push_back(opening);
  };
  for (const DeviceView& leaf : view.devices("gap", within)) {
    for (const HomeDoor::Kind kind : {HomeDoor::Kind::kDoor, HomeDoor::Kind::kWindow}) {
      const HomeDoor* door = leaf.kind == name_of(kind) ? plan.home.door(kind, leaf.name) : nullptr;
      if (door == nullptr) continue;
      add(*door, leaf.state.get<double>("gap"), leaf.state.get<double>("width"),
          leaf.state.get<double>("height"));
    }
  }
  for (const HomeDoor& door : plan.home.doors) {
    if (door.kind == HomeDoor::Kind::kOpening) add(door, door.width, door.width, door.height);
  }
  return openings;
}

AirHere air_at(const View& view, const Vec3& point) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  AirHere outside{kNone, kNone};
  const Room* room = view.home().room_at(point);
  for (const DeviceView& climate : climates(view)) {
    if (room != nullptr && room->model == climate.model) {
      return {climate.state.get<std::vector<double>>("temperatures").at(room->number),
              climate.state.get<std::vector<double>>("humidities").at(room->number)};
    }
    outside = {climate.state.get<double>("outside_temperature"),
               climate.state.get<double>("outside_humidity")};
  }
  return outside;
}

double air_temperature(const View& view, const Vec3& point) {
  constexpr double kZeroCelsius = 273.15;  // K
  const double here = air_at(view, point).temperature;
  return std::isnan(here) ? view.ambient_temperature() : here + kZeroCelsius;
}

}  // namespace angen

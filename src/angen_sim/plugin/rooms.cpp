#include "plugin/rooms.h"

#include <cmath>
#include <limits>
#include <string>

#include "core/named.h"
#include "plugin/view.h"

namespace angen {

namespace {

const char* const kClimate = "climate";
const char* const kClimateField = "outside_humidity";

/// The climate of a room's model: usually it has the model's name; else it is looked for.
std::optional<DeviceView> climate_of(const View& view, const Room& room) {
  auto named = view.device(kClimateField, kClimate, room.model);
  if (named && named->model == room.model) return named;
  for (const DeviceView& climate : climates(view)) {
    if (climate.model == room.model) return climate;
  }
  return std::nullopt;
}

}  // namespace

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

bool has_climate(const View& view, const Room& room) {
  return view.has_device(kClimateField, kClimate, room.model) || climate_of(view, room);
}

std::vector<DeviceView> climates(const View& view) {
  std::vector<DeviceView> found;
  for (const DeviceView& device : view.devices(kClimateField)) {
    if (device.kind == kClimate) found.push_back(device);
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
  const Room* room = view.home().room_at(point);
  if (room != nullptr) {
    if (const auto climate = climate_of(view, *room)) {
      return {climate->state.get<std::vector<double>>("temperatures").at(room->number),
              climate->state.get<std::vector<double>>("humidities").at(room->number)};
    }
  }
  const std::vector<DeviceView> all = climates(view);
  if (all.empty()) return {kNone, kNone};
  return {all.back().state.get<double>("outside_temperature"),
          all.back().state.get<double>("outside_humidity")};
}

double air_temperature(const View& view, const Vec3& point) {
  constexpr double kZeroCelsius = 273.15;  // K
  const double here = air_at(view, point).temperature;
  return std::isnan(here) ? view.ambient_temperature() : here + kZeroCelsius;
}

}  // namespace angen

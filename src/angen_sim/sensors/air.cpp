#include "sensors/air.h"

#include <limits>

namespace angen::sensors {

namespace {

constexpr double kWall = 0.05;  // m: what hangs in a wall is in the room

bool inside(const std::vector<double>& rooms, std::size_t room, const Vec3& point) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t low = 6 * room + static_cast<std::size_t>(axis);
    if (point[axis] < rooms[low] - kWall || point[axis] > rooms[low + 3] + kWall) return false;
  }
  return true;
}

}  // namespace

AirHere air_at(const View& view) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  AirHere outside{kNone, kNone};
  const Vec3 here = view.pose().position;
  for (const DeviceView& device : view.devices("temperatures")) {
    if (device.kind != "climate") continue;
    const auto rooms = device.state.get<std::vector<double>>("rooms");
    const auto temperatures = device.state.get<std::vector<double>>("temperatures");
    const auto humidities = device.state.get<std::vector<double>>("humidities");
    const Vec3 point = device.pose.inverse() * here;
    for (std::size_t i = 0; i < temperatures.size(); ++i) {
      if (inside(rooms, i, point)) return {temperatures[i], humidities[i]};
    }
    outside = {device.state.get<double>("outside_temperature"),
               device.state.get<double>("outside_humidity")};
  }
  return outside;
}

void AirSensor::configure(Params& params, Wiring&) {
  noise_stddev_ = params.noise(name_, unit_, "of a reading");
}

void AirSensor::read(const View& view, Hits, Rng&, Reading& reading) {
  reading.set(name_, air_at(view).*number_);
  reading.set("variance", noise_stddev_ * noise_stddev_);
}

}  // namespace angen::sensors

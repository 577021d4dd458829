#include "devices/room_air.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace angen::devices {

namespace {

constexpr double kPressure = 101325.0;  // Pa
constexpr double kDensity = 1.204;      // kg/m^3 of air at 20 degrees
constexpr double kHeat = 1006.0;        // J/(kg K) of air
constexpr double kVapor = 0.622;        // molar mass of water over that of dry air
constexpr double kKelvin = 273.15;
constexpr double kGravity = 9.81;
constexpr double kValveBand = 2.0;  // K, at which EN 215 rates a thermostatic valve
constexpr double kDischarge = 0.6;  // coefficient of a sharp-edged opening

// Pa over water, Magnus with Sonntag's constants (1990), -45 to 60 degrees.
double saturation(double temperature) {
  return 611.2 * std::exp(17.62 * temperature / (243.12 + temperature));
}

// Moist air is lighter: the temperature of dry air of its density, K.
double buoyant(const Air& air) { return (air.temperature + kKelvin) * (1.0 + 0.61 * air.moisture); }

}  // namespace

double vapor_pressure(double temperature, double humidity) {
  return humidity / 100.0 * saturation(temperature);
}

double moisture_of(double temperature, double humidity) {
  const double vapor = vapor_pressure(temperature, humidity);
  return kVapor * vapor / (kPressure - vapor);
}

double humidity_of(const Air& air) {
  const double vapor = kPressure * air.moisture / (kVapor + air.moisture);
  return std::min(100.0, 100.0 * vapor / saturation(air.temperature));
}

double doorway_flow(const Opening& opening, const Air& a, const Air& b) {
  const double warm = buoyant(a);
  const double cold = buoyant(b);
  const double drive = kGravity * std::abs(warm - cold) / (0.5 * (warm + cold));
  return kDischarge / 3.0 * opening.width * std::sqrt(drive * std::pow(opening.height, 3));
}

RoomAir::RoomAir(const Settings& settings, std::vector<double> volumes, const Air& air)
    : settings_(settings), volumes_(std::move(volumes)), rooms_(volumes_.size(), air) {}

// W/m^3 in a room of this temperature.
double RoomAir::radiator_power(double temperature) const {
  return settings_.heating_power * std::clamp((heating_ - temperature) / kValveBand, 0.0, 1.0);
}

void RoomAir::step(double seconds, const Air& outside, const std::vector<double>& heat,
                   const std::vector<Opening>& openings, const std::vector<double>& source) {
  const auto at = [&](int room) -> const Air& {
    return room < 0 ? outside : rooms_[static_cast<std::size_t>(room)];
  };
  std::vector<double> power = heat;               // W
  std::vector<double> vapor(rooms_.size(), 0.0);  // m^3/s times kg/kg
  for (std::size_t i = 0; i < source.size(); ++i) vapor[i] = source[i] / kDensity;
  for (std::size_t i = 0; i < rooms_.size(); ++i) {
    const double leak = settings_.air_change * volumes_[i];
    const double loss = settings_.heat_loss * volumes_[i] + kDensity * kHeat * leak;
    power[i] += loss * (outside.temperature - rooms_[i].temperature);
    power[i] += volumes_[i] * radiator_power(rooms_[i].temperature);
    vapor[i] += leak * (outside.moisture - rooms_[i].moisture);
  }
  for (const Opening& opening : openings) {
    const double flow = doorway_flow(opening, at(opening.first), at(opening.second));
    for (const auto& [here, there] :
         {std::pair(opening.first, opening.second), std::pair(opening.second, opening.first)}) {
      if (here < 0) continue;
      const auto i = static_cast<std::size_t>(here);
      power[i] += kDensity * kHeat * flow * (at(there).temperature - rooms_[i].temperature);
      vapor[i] += flow * (at(there).moisture - rooms_[i].moisture);
    }
  }
  for (std::size_t i = 0; i < rooms_.size(); ++i) {
    const double capacity = settings_.heat_capacity * kDensity * kHeat * volumes_[i];
    Air& room = rooms_[i];
    room.temperature += power[i] * seconds / capacity;
    // Vapor above saturation is dew on the panes.
    room.moisture = std::clamp(room.moisture + vapor[i] * seconds / volumes_[i], 0.0,
                               moisture_of(room.temperature, 100.0));
  }
}

}  // namespace angen::devices

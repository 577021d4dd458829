#pragma once

#include <vector>

namespace angen::devices {

/// Air of one room: evenly mixed.
struct Air {
  double temperature = 20.0;  // degrees Celsius
  double moisture = 0.0;      // kg of vapor a kg of dry air
};

/// Vapor in air of a temperature (degrees Celsius) and relative humidity (percent), kg/kg.
double moisture_of(double temperature, double humidity);
/// Pa of vapor in such air.
double vapor_pressure(double temperature, double humidity);
/// Relative humidity in percent of air, at most 100.
double humidity_of(const Air& air);

/// Exchange through one opening between two rooms.
struct Opening {
  int first = -1;  // room, -1 the outside
  int second = -1;
  double width = 0.0;   // m, free
  double height = 0.0;  // m
};

/// Well-mixed rooms that lose heat to the outside and exchange air with it and with each other.
class RoomAir {
 public:
  struct Settings {
    double heat_loss = 0.0;      // W/(K m^3), through walls and windows
    double air_change = 0.0;     // 1/s, with the outside through cracks
    double heat_capacity = 1.0;  // heat capacity of the room's contents by that of its air
    double heating_power = 0.0;  // W/m^3, of radiators that are fully open
  };

  RoomAir() = default;
  /// `volumes` in m^3, all full of `air`.
  RoomAir(const Settings& settings, std::vector<double> volumes, const Air& air);

  /// Radiators heat each room to `temperature` (degrees Celsius): their valves are shut there, and
  /// fully open 2 K below.
  void heat_to(double temperature) { heating_ = temperature; }

  /// By `seconds`, with `heat` (W) and, where given, `vapor` (kg/s) in each room.
  void step(double seconds, const Air& outside, const std::vector<double>& heat,
            const std::vector<Opening>& openings, const std::vector<double>& vapor = {});

  /// Replaces the air of one room.
  void fill(std::size_t room, const Air& air) { rooms_.at(room) = air; }
  const std::vector<Air>& rooms() const { return rooms_; }

 private:
  double radiator_power(double temperature) const;

  Settings settings_;
  double heating_ = -273.15;  // degrees Celsius
  std::vector<double> volumes_;
  std::vector<Air> rooms_;
};

/// m^3/s that flow each way through an open doorway between a warm and a cold side.
double doorway_flow(const Opening& opening, const Air& a, const Air& b);

}  // namespace angen::devices

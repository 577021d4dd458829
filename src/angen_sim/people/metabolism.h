#pragma once

namespace angen::people {

/// Heat and vapor that a person gives to the air of a room.
struct Metabolism {
  double heat = 0.0;   // W, dry
  double vapor = 0.0;  // g/h, of breath and skin
};

/// W of heat for each m^2 of the body, of a person who stands relaxed, or walks on level ground
/// at that speed (m/s): ISO 8996 and the table of ISO 7730, annex B.
double metabolic_rate(double speed);
constexpr double kSeated = 58.0;     // W/m^2, of the same tables
constexpr double kReclining = 46.0;  // W/m^2

/// Its division in air of that temperature (degrees Celsius) and relative humidity (percent), for a
/// body of 1.8 m^2: ISO 7730, 4.1.
Metabolism metabolism(double rate, double celsius, double humidity);

}  // namespace angen::people

#include "people/metabolism.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "devices/room_air.h"

namespace angen::people {

namespace {

constexpr double kBodyArea = 1.8;        // m^2
constexpr double kEvaporation = 2430.0;  // J/g, of water at the skin's temperature

struct Rate {
  double speed;  // m/s
  double rate;   // W/m^2
};
constexpr Rate kRates[] = {
    {0.0, 70.0}, {0.556, 110.0}, {0.833, 140.0}, {1.111, 165.0}, {1.389, 200.0}};

}  // namespace

double metabolic_rate(double speed) {
  std::size_t next = 1;
  while (next + 1 < std::size(kRates) && speed > kRates[next].speed) ++next;
  const Rate& low = kRates[next - 1];
  const Rate& high = kRates[next];
  return low.rate + (high.rate - low.rate) * (speed - low.speed) / (high.speed - low.speed);
}

Metabolism metabolism(double rate, double celsius, double humidity) {
  const double pressure = devices::vapor_pressure(celsius, humidity);
  const double diffusion = std::max(0.0, 3.05e-3 * (5733.0 - 6.99 * rate - pressure));
  const double sweat = 0.42 * std::max(0.0, rate - 58.15);
  const double breath = std::max(0.0, 1.7e-5 * rate * (5867.0 - pressure));
  const double moist = kBodyArea * (diffusion + sweat + breath);  // W
  return {kBodyArea * rate - moist, 3600.0 * moist / kEvaporation};
}

}  // namespace angen::people

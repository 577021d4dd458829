// libbarometer.so
#include <cmath>

#include "plugin/registration.h"
#include "plugin/view.h"

namespace angen::sensors {

namespace {

constexpr double kGasConstant = 8.314462618;  // J/(mol K), CODATA 2018
constexpr double kMolarMass = 0.0289644;      // kg/mol of dry air, US Standard Atmosphere 1976

}  // namespace

/// A barometer: the pressure of air that is as warm everywhere, at its height.
class Barometer : public Sensor {
 public:
  void configure(Params& params, Wiring&) override {
    ground_ =
        params.number("ground_pressure", 101325.0, "Pa", "at height 0 of the world", {1e3, 2e5});
    reference_ = params.number("reference_pressure", 101325.0, "Pa",
                               "where its altitude counts from", {1e3, 2e5});
    stddev_ = params.noise("pressure", "Pa", "of a pressure");
  }

  void read(const View& view, Hits, Rng&, Reading& reading) override {
    const double energy = kMolarMass * -view.gravity().dot(view.pose().position);  // J/mol
    const double share = std::exp(-energy / (kGasConstant * view.ambient_temperature()));
    reading.set("pressure", ground_ * share);
    reading.set("variance", stddev_ * stddev_);
    reading.set("reference_pressure", reference_);
  }

  Nanoseconds idle_until(const Ahead&) const override { return kForever; }

 private:
  double ground_ = 0.0;     // Pa
  double reference_ = 0.0;  // Pa
  double stddev_ = 0.0;     // Pa
};

ANGEN_REGISTER_SENSOR(Barometer,
                      Kind("barometer", "A barometer, which tells floors apart.")
                          .rate(1.0)
                          .model("barometer")
                          .example("spawn barometer b1 --on elevator::cabin --pose \"0 0 1\"")
                          .number("pressure", "Pa", "of the air")
                          .shown(1)
                          .number("variance", "Pa^2", "of its noise")
                          .number("reference_pressure", "Pa", "as its parameter"))

}  // namespace angen::sensors

// libsoil_moisture.so
#include <limits>

#include "plugin/registration.h"
#include "plugin/view.h"

namespace angen::sensors {

namespace {

constexpr double kReach = 0.5;  // m, from the probe to the origin of its plant

}  // namespace

/// A capacitive probe in a pot: the water in its soil.
class SoilMoisture : public Sensor {
 public:
  void configure(Params& params, Wiring&) override {
    dry_below_ = params.number("dry_below", 21.0, "%", "it says dry below this", {0.0, 100.0});
    params.noise("moisture", "%", "of a reading");
  }

  void read(const View& view, Hits, Rng&, Reading& reading) override {
    const Vec3 here = view.pose().position;
    const Eigen::AlignedBox3d around(here - Vec3::Constant(kReach), here + Vec3::Constant(kReach));
    double nearest = kReach;
    double moisture = std::numeric_limits<double>::quiet_NaN();
    for (const DeviceView& device : view.devices("moisture", around)) {
      const double distance = (device.pose.position - here).norm();
      if (device.kind != "plant" || distance > nearest) continue;
      nearest = distance;
      moisture = device.state.get<double>("moisture");
    }
    const bool dry = moisture < dry_below_;
    if (dry != dry_) {
      reading.announce(dry ? "dry" : "wet");
    }
    dry_ = dry;
    reading.set("moisture", moisture);
    reading.set("dry", dry);
  }

  Nanoseconds idle_until(const Ahead&) const override { return kForever; }

 private:
  double dry_below_ = 0.0;  // %
  bool dry_ = false;
};

ANGEN_REGISTER_SENSOR(SoilMoisture,
                      Kind("soil_moisture", "The water in the soil of its pot.")
                          .rate(1.0)
                          .example("spawn soil_moisture s1 --pose \"4.65 5.7 0.2\"")
                          .number("moisture", "%", "of the soil's volume; NaN outside of a pot")
                          .shown(1)
                          .flag("dry", "whether it is below dry_below")
                          .alarm("DRY", "")
                          .events("dry", "wet"))

}  // namespace angen::sensors

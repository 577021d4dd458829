#include <algorithm>
#include <cmath>
#include <limits>

#include "plugin/register.h"
#include "sensors/fan.h"

namespace angen::sensors {

namespace {

Fan default_fan() {
  Fan fan;
  fan.columns = fan.rows = 5;
  fan.max_yaw = fan.max_pitch = 0.13;
  fan.min_yaw = fan.min_pitch = -0.13;
  fan.min = 0.02;
  fan.max = 4.0;
  return fan;
}

}  // namespace

/// The diray_set to the nearest thing in a narrow cone, as an ultrasonic or infrared ranger
/// measures it.
class Proximity : public Sensor {
 public:
  void configure(Params& params, Wiring&) override {
    fan_ = read_fan(params, default_fan());
    directions_ = fan_.directions();
    // One range, one error: the least of many noisy rays would always be too short.
    fan_.declare_noise("range", params);
    infrared_ = params.choice("radiation", "ultrasound", {"ultrasound", "infrared"},
                              "what its message says that it sends out") == "infrared";
  }

  int ray_set(const View&) override { return 0; }
  void aim(const View& view, RayBatch& rays) override { fan_.aim(view.pose(), directions_, rays); }

  void read(const View&, Hits hits, Rng&, Reading& reading) override {
    const auto nearest = std::min_element(
        hits.begin(), hits.end(), [](const auto& a, const auto& b) { return a.range < b.range; });
    const bool meets = nearest != hits.end() && nearest->hit();
    reading.set("range", meets ? nearest->range : std::numeric_limits<double>::infinity());
    reading.set("near", meets);
    reading.set("ranges", fan_.measure(hits));
    reading.set("field_of_view", fan_.max_yaw - fan_.min_yaw);
    reading.set("min_range", fan_.min);
    reading.set("max_range", fan_.max);
    reading.set("infrared", infrared_);
  }

  bool steady() const override { return true; }

 private:
  Fan fan_;
  bool infrared_ = false;
  std::vector<Vec3> directions_;
};

ANGEN_REGISTER_SENSOR(
    Proximity, Kind("proximity", "The distance to the nearest thing in a narrow cone.")
                   .model("proximity")
                   .example("spawn proximity d1 --pose \"1 1 0.5 0 0 1.57\" --set ray/range/max=2")
                   .rays("0.1 0.5 0.9 0.45")
                   .number("range", "m", "to the nearest thing, infinite where nothing is in reach")
                   .shown(3)
                   .flag("near", "whether anything is in reach")
                   .alarm("near", "nothing near")
                   .numbers("ranges", "m", "of each ray, without noise, at most max_range")
                   .number("field_of_view", "rad", "full angle of the cone")
                   .number("min_range", "m", "nearer things are not measured")
                   .number("max_range", "m", "farther things are not measured")
                   .flag("infrared", "it is infrared rather than ultrasonic"))

}  // namespace angen::sensors

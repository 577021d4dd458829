#include <algorithm>
#include <cmath>
#include <limits>

#include "plugin/register.h"
#include "sensors/fan.h"
#include "sensors/one_draw.h"

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

/// What the rays met; as an echo, what is read while they meet the same.
struct Cone : OneDraw {
  Fan fan;
  bool infrared = false;
  Ranges ranges;
  double nearest = 0.0;  // m, infinite where nothing is met

  void tell(Rng rng, Reading& reading) const override {
    double range = nearest;
    if (std::isfinite(nearest)) {
      // One echo, one error: the least of many noisy rays would always be too short.
      const double noise = fan.noise_stddev > 0.0 ? fan.noise_stddev * rng.gaussian() : 0.0;
      range = std::clamp(nearest + fan.noise_mean + noise, fan.min, fan.max);
    }
    reading.set("range", range);
    reading.set("near", std::isfinite(range));
    reading.set("ranges", ranges);  // for those who draw the rays
    reading.set("field_of_view", fan.max_yaw - fan.min_yaw);
    reading.set("min_range", fan.min);
    reading.set("max_range", fan.max);
    reading.set("infrared", infrared);
  }
};

}  // namespace

/// The distance to the nearest thing in a narrow cone, as an ultrasonic or infrared ranger tells
/// it.
class Proximity : public Sensor {
 public:
  void configure(Params& params, Wiring&) override {
    cone_.fan = read_fan(params, default_fan());
    directions_ = cone_.fan.directions();
    cone_.infrared = params.choice("radiation", "ultrasound", {"ultrasound", "infrared"},
                                   "what its message says that it sends out") == "infrared";
  }

  int stance(const View&) override { return 0; }
  void aim(const View& view, RayBatch& rays) override {
    cone_.fan.aim(view.pose(), directions_, rays);
  }

  void read(const View&, Hits hits, Rng& rng, Reading& reading) override {
    cone_.ranges = cone_.fan.measure(hits);
    const auto nearest = std::min_element(
        hits.begin(), hits.end(), [](const auto& a, const auto& b) { return a.range < b.range; });
    const bool meets = nearest != hits.end() && nearest->hit();
    cone_.nearest = meets ? nearest->range : std::numeric_limits<double>::infinity();
    cone_.tell(rng, reading);
  }

  Rest rest() const override { return cone_.fan.noise_stddev > 0.0 ? Rest::kNoise : Rest::kSame; }
  double quiet_chance() const override { return 1.0; }  // it tells no events
  std::shared_ptr<const Echo> echo() const override { return std::make_shared<Cone>(cone_); }

 private:
  Cone cone_;
  std::vector<Vec3> directions_;
};

ANGEN_REGISTER_SENSOR(Proximity, "proximity", "The distance to the nearest thing in a narrow cone.")

}  // namespace angen::sensors

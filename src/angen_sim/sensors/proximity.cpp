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

/// The distance to the nearest thing in a narrow cone, as an ultrasonic or infrared ranger tells
/// it.
class Proximity : public Sensor {
 public:
  void configure(Params& params, Wiring&) override {
    fan_ = read_fan(params, default_fan());
    directions_ = fan_.directions();
    infrared_ = params.choice("radiation", "ultrasound", {"ultrasound", "infrared"},
                              "what its message says that it sends out") == "infrared";
  }

  int stance(const View&) override { return 0; }
  void aim(const View& view, RayBatch& rays) override { fan_.aim(view.pose(), directions_, rays); }

  void read(const View&, Hits hits, Rng& rng, Reading& reading) override {
    std::vector<double> ranges;
    ranges.reserve(hits.size());
    for (const rays::Hit& hit : hits) ranges.push_back(std::min(hit.range, fan_.max));
    const auto nearest = std::min_element(
        hits.begin(), hits.end(), [](const auto& a, const auto& b) { return a.range < b.range; });
    double range = std::numeric_limits<double>::infinity();
    if (nearest != hits.end() && nearest->hit()) {
      // One echo, one error: the least of many noisy rays would always be too short.
      const double noise = fan_.noise_stddev > 0.0 ? fan_.noise_stddev * rng.gaussian() : 0.0;
      range = std::clamp(nearest->range + fan_.noise_mean + noise, fan_.min, fan_.max);
    }
    reading.set("range", range);
    reading.set("near", std::isfinite(range));
    reading.set("ranges", std::move(ranges));  // for those who draw the rays
    reading.set("field_of_view", fan_.max_yaw - fan_.min_yaw);
    reading.set("min_range", fan_.min);
    reading.set("max_range", fan_.max);
    reading.set("infrared", infrared_);
  }

  Rest rest() const override { return fan_.noise_stddev > 0.0 ? Rest::kNoise : Rest::kSame; }
  bool quiet(Rng) const override { return true; }  // it tells no events

 private:
  Fan fan_;
  std::vector<Vec3> directions_;
  bool infrared_ = false;
};

ANGEN_REGISTER_SENSOR(Proximity, "proximity", "The distance to the nearest thing in a narrow cone.")

}  // namespace angen::sensors

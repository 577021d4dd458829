#include "sensors/proximity.h"

#include <algorithm>
#include <limits>

namespace angen::sensors {

namespace {

Fan proximity_fan() {
  Fan fan;
  fan.columns = fan.rows = 5;
  fan.max_yaw = fan.max_pitch = 0.13;
  fan.min_yaw = fan.min_pitch = -0.13;
  fan.min = 0.02;
  fan.max = 4.0;
  return fan;
}

}  // namespace

void Proximity::read_rays(Params& params) {
  read_fan(params, proximity_fan());
  // One range, one error: the least of many noisy rays would always be too short.
  const double noise = params.number("gaussianNoise", 0.0, "m",
                                     "standard deviation, in place of the rays'", kNotNegative);
  if (noise > 0.0) fan_.noise_stddev = noise;
  fan_.declare_noise("range", params);
  field_of_view_ = fan_.max_yaw - fan_.min_yaw;
}

void Proximity::configure(Params& params, Wiring&) {
  read_rays(params);
  infrared_ = params.choice("radiation", "ultrasound", {"ultrasound", "infrared"},
                            "radiation type in its message") == "infrared";
  field_of_view_ =
      params.number("fov", field_of_view_, "rad",
                    "field of view in its message; the cone is as wide as its rays", {0.0, 7.0});
}

void Proximity::read(const View& view, Hits hits, Rng&, Reading& reading) {
  Ranges ranges = scan(view, hits);
  const double nearest = *std::min_element(ranges.begin(), ranges.end());
  reading.set("range", nearest);
  reading.set("near", nearest < std::numeric_limits<double>::infinity());
  for (double& range : ranges) range = std::clamp(range, 0.0, fan_.max);
  reading.set("ranges", std::move(ranges));
  reading.set("field_of_view", field_of_view_);
  reading.set("min_range", fan_.min);
  reading.set("max_range", fan_.max);
  reading.set("infrared", infrared_);
}

Kind proximity_kind(Kind kind) {
  return kind.ray_color("0.1 0.5 0.9 0.45")
      .number("range", "m",
              "to the nearest thing, infinite if nothing is in reach, -infinite if "
              "something is nearer than <min>")
      .shown(3)
      .flag("near", "whether anything is in reach")
      .alarm("near", "nothing near")
      .numbers("ranges", "m", "of each ray, without noise, at most max_range")
      .number("field_of_view", "rad", "full angle of the cone")
      .number("min_range", "m", "nearer things are not measured")
      .number("max_range", "m", "farther things are not measured")
      .flag("infrared", "it is infrared rather than ultrasonic");
}

}  // namespace angen::sensors

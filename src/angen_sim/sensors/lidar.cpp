// libgazebo_ros_laser.so libgazebo_ros_gpu_laser.so
#include <algorithm>
#include <cmath>

#include "plugin/registration.h"
#include "sensors/fan.h"

namespace angen::sensors {

namespace {

Fan default_fan() {
  Fan fan;
  fan.columns = 360;
  fan.min_yaw = -M_PI;
  fan.max_yaw = M_PI - 2.0 * M_PI / 360.0;
  fan.min = 0.12;
  fan.max = 10.0;
  return fan;
}

}  // namespace

/// A planar laser scanner. Ranges without a hit and too near are infinite, as REP 117 requires.
class Lidar : public Scanner {
 public:
  void configure(Params& params, Wiring&) override {
    read_fan(params, default_fan());
    if (fan_.rows != 1) {
      throw params.error("ray/scan/vertical/samples",
                         "a lidar has " + std::to_string(fan_.rows) + " rows of rays, must have 1");
    }
    period_ = to_seconds(params.update_period());
    fan_.declare_noise("ranges", params);
  }

  void read(const View& view, Hits hits, Rng&, Reading& reading) override {
    const int steps = std::max(1, fan_.columns - 1);
    reading.set("ranges", scan(view, hits));
    reading.set("angle_min",
                fan_.columns == 1 ? 0.5 * (fan_.min_yaw + fan_.max_yaw) : fan_.min_yaw);
    reading.set("angle_max",
                fan_.columns == 1 ? 0.5 * (fan_.min_yaw + fan_.max_yaw) : fan_.max_yaw);
    reading.set("angle_increment", (fan_.max_yaw - fan_.min_yaw) / steps);
    reading.set("scan_time", period_);
    reading.set("range_min", fan_.min);
    reading.set("range_max", fan_.max);
  }

 private:
  double period_ = 0.0;  // s
};

ANGEN_REGISTER_SENSOR(
    Lidar, Kind("lidar", "A planar laser scanner.")
               .rate(10.0)
               .on_demand()
               .numbers("ranges", "m",
                        "of each ray, infinite without a hit, -infinite if nearer than <min>")
               .number("angle_min", "rad", "of the first ray")
               .number("angle_max", "rad", "of the last ray")
               .number("angle_increment", "rad", "between two rays")
               .number("scan_time", "s", "between two scans")
               .number("range_min", "m", "nearest")
               .number("range_max", "m", "farthest")
               .shown(1))

}  // namespace angen::sensors

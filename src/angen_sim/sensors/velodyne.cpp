// libgazebo_ros_velodyne_laser.so libgazebo_ros_velodyne_gpu_laser.so
#include <algorithm>

#include "plugin/registration.h"
#include "sensors/cloud.h"

namespace angen::sensors {

/// The spinning scanner of velodyne_gazebo_plugins.
class Velodyne : public Cloud {
 public:
  void configure(Params& params, Wiring&) override {
    read_rays(params);
    const double least =
        params.number("min_range", 0.0, "m", "nearer is not seen, beside the rays'", kNotNegative);
    const double most = params.number("max_range", fan_.max, "m",
                                      "farther is not seen, beside the rays'", kPositive);
    organized_ = params.flag("organize_cloud", false, "points in rows and columns, NaN for none");
    least_intensity_ = params.number("min_intensity", 0.0, "", "weaker returns are left out");
    fan_.min = std::max(fan_.min, least);
    fan_.max = std::min(fan_.max, most);
    if (fan_.min > fan_.max) throw params.error("max_range", "<max_range> is below <min_range>");
  }
};

ANGEN_REGISTER_SENSOR(Velodyne, cloud_kind(Kind("velodyne",
                                                "A spinning scanner with a ring of rays "
                                                "for each of its lasers.")))

}  // namespace angen::sensors

// libgazebo_ros_block_laser.so
#include "plugin/registration.h"
#include "sensors/cloud.h"

namespace angen::sensors {

/// Gazebo's scanner of a block of rays.
class BlockLaser : public Cloud {
 public:
  void configure(Params& params, Wiring&) override {
    read_rays(params);
    params.number("hokuyoMinIntensity", 101.0, "", "not used, as in Gazebo");
  }
};

ANGEN_REGISTER_SENSOR(BlockLaser,
                      cloud_kind(Kind("block_laser", "A scanner with several rows of rays.")))

}  // namespace angen::sensors

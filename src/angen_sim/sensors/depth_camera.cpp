// libgazebo_ros_depth_camera.so
#include <limits>

#include "plugin/register.h"
#include "sensors/depth.h"

namespace angen::sensors {

struct DepthCamera : Depth {
  DepthCamera() : Depth(std::numeric_limits<double>::infinity()) {}
};

ANGEN_REGISTER_SENSOR(DepthCamera, depth_kind(Kind("depth_camera",
                                                   "A depth camera that sees as far as its lens.")))

}  // namespace angen::sensors

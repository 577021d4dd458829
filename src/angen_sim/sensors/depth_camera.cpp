// libgazebo_ros_depth_camera.so
#include <limits>

#include "plugin/registration.h"
#include "sensors/depth.h"

namespace angen::sensors {

struct DepthCamera : Depth {
  DepthCamera() : Depth(std::numeric_limits<double>::infinity()) {}
};

ANGEN_REGISTER_SENSOR(DepthCamera, depth_kind(Kind("depth_camera",
                                                   "A depth camera with the range of its lens.")))

}  // namespace angen::sensors

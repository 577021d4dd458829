// libgazebo_ros_openni_kinect.so
#include "plugin/registration.h"
#include "sensors/depth.h"

namespace angen::sensors {

struct Kinect : Depth {
  Kinect() : Depth(5.0) {}
};

ANGEN_REGISTER_SENSOR(Kinect, depth_kind(Kind("depth", "A depth camera: meters along its axis.")))

}  // namespace angen::sensors

// libhector_gazebo_ros_sonar.so
#include <algorithm>

#include "plugin/registration.h"
#include "sensors/proximity.h"

namespace angen::sensors {

/// The sonar of hector_gazebo_plugins.
class Sonar : public Proximity {
 public:
  void configure(Params& params, Wiring&) override {
    read_rays(params);
    // The message's field of view: the narrower side of the cone.
    field_of_view_ = std::min(field_of_view_, fan_.max_pitch - fan_.min_pitch);
    params.text("frameId", "", "frame_id of its messages");
    for (const char* path : {"offset", "drift", "driftFrequency"}) {
      params.text(path, "", "not used: its error is gaussianNoise");
    }
  }
};

ANGEN_REGISTER_SENSOR(
    Sonar, proximity_kind(Kind("sonar", "The distance to the nearest thing in a cone, by sound.")))

}  // namespace angen::sensors

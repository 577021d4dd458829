// libgazebo_ros_range.so
#include "plugin/registration.h"
#include "sensors/proximity.h"

namespace angen::sensors {

ANGEN_REGISTER_SENSOR(
    Proximity,
    proximity_kind(Kind("proximity", "The distance to the nearest thing in a narrow cone.")
                       .model("proximity")
                       .example("spawn proximity d1 --pose \"1 1 0.5 0 0 1.57\" --set "
                                "ray/range/max=2")))

}  // namespace angen::sensors

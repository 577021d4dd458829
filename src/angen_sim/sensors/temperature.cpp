#include "plugin/register.h"
#include "sensors/air.h"

namespace angen::sensors {

/// The temperature of the air in the room that it is in.
class Temperature : public AirSensor {
 public:
  Temperature() : AirSensor("temperature", "degC", &AirHere::temperature) {}
};

ANGEN_REGISTER_SENSOR(Temperature, "temperature", "The temperature of the air in its room.")

}  // namespace angen::sensors

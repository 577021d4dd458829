#include "plugin/register.h"
#include "sensors/air.h"

namespace angen::sensors {

/// The relative humidity of the air in the room that it is in.
class Humidity : public AirSensor {
 public:
  Humidity() : AirSensor("humidity", "%", &AirHere::humidity) {}
};

ANGEN_REGISTER_SENSOR(Humidity, "humidity", "The relative humidity of the air in its room.")

}  // namespace angen::sensors

// libhumidity_sensor.so
#include "plugin/registration.h"
#include "sensors/air.h"

namespace angen::sensors {

/// The relative humidity of the air in the room that it is in.
class Humidity : public AirSensor {
 public:
  Humidity() : AirSensor("humidity", "%", &AirHere::humidity) {}
};

ANGEN_REGISTER_SENSOR(Humidity,
                      Kind("humidity", "The relative humidity of the air in its room.")
                          .rate(1.0)
                          .model("humidity_sensor")
                          .example("spawn humidity h1 --pose \"0.1 2.1 1.5\"")
                          .number("humidity", "%",
                                  "of the air in its room; NaN where the world has no climate")
                          .shown(2)
                          .number("variance", "(%)^2", "of its noise"))

}  // namespace angen::sensors

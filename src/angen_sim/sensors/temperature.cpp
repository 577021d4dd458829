// libtemperature_sensor.so
#include "plugin/registration.h"
#include "sensors/air.h"

namespace angen::sensors {

/// The temperature of the air in the room that it is in.
class Temperature : public AirSensor {
 public:
  Temperature() : AirSensor("temperature", "degC", &AirHere::temperature) {}
};

ANGEN_REGISTER_SENSOR(
    Temperature,
    Kind("temperature", "The temperature of the air in its room.")
        .rate(1.0)
        .model("temperature_sensor")
        .example("spawn temperature t1 --pose \"0.1 2 1.5\" --set noise_stddev=0.1")
        .number("temperature", "°C", "of the air in its room; NaN where the world has no climate")
        .shown(2)
        .number("variance", "(°C)^2", "of its noise"))

}  // namespace angen::sensors

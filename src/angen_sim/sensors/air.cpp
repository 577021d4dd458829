#include "sensors/air.h"

#include "plugin/view.h"

namespace angen::sensors {

void AirSensor::configure(Params& params, Wiring&) {
  noise_stddev_ = params.noise(name_, unit_, "of a reading");
}

void AirSensor::read(const View& view, Hits, Rng&, Reading& reading) {
  reading.set(name_, air_at(view, view.pose().position).*number_);
  reading.set("variance", noise_stddev_ * noise_stddev_);
}

}  // namespace angen::sensors

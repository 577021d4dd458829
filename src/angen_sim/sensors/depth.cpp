#include "plugin/register.h"
#include "sensors/lens.h"

namespace angen::sensors {

/// A depth camera that looks along its x axis, z up: distances along the axis, not along the rays.
class Depth : public Sensor {
 public:
  bool on_demand() const override { return true; }
  double default_rate() const override { return 30.0; }

  void configure(Params& params, Wiring&) override {
    lens_ = read_lens(params);
    params.text("depthImageTopicName", "image_raw", "the depths, below cameraName");
    params.text("depthImageCameraInfoTopicName", "camera_info", "the lens, below cameraName");
    params.text("pointCloudTopicName", "points", "the points, below cameraName");
  }

  void read(const View& view, Hits, Rng&, Reading& reading) override {
    reading.set("depth", image(lens_, view.depths(lens_, view.pose()), 1));
    tell_lens(lens_, reading);
  }

 private:
  render::Lens lens_;
};

ANGEN_REGISTER_SENSOR(Depth, "depth", "A depth camera: metres along its axis.")

}  // namespace angen::sensors

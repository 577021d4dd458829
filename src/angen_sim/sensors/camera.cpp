#include "plugin/register.h"
#include "sensors/lens.h"

namespace angen::sensors {

/// A colour camera that looks along its x axis, z up.
class Camera : public Sensor {
 public:
  bool on_demand() const override { return true; }
  double default_rate() const override { return 30.0; }

  void configure(Params& params, Wiring&) override {
    lens_ = read_lens(params);
    params.text("imageTopicName", "image_raw", "the image, below cameraName");
    params.text("cameraInfoTopicName", "camera_info", "the lens, below cameraName");
  }

  void read(const View& view, Hits, Rng&, Reading& reading) override {
    reading.set("image", image(lens_, view.colors(lens_, view.pose()), 3));
    tell_lens(lens_, reading);
  }

 private:
  render::Lens lens_;
};

ANGEN_REGISTER_SENSOR(Camera, "camera", "A colour camera under the lamps' light.")

}  // namespace angen::sensors

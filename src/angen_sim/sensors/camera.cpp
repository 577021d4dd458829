#include "plugin/register.h"
#include "sensors/camera_params.h"

namespace angen::sensors {

/// A color camera that looks along its x axis, z up.
class Camera : public Sensor {
 public:
  void configure(Params& params, Wiring&) override {
    camera_ = read_camera(params);
    params.text("imageTopicName", "image_raw", "the image, below cameraName");
    params.text("cameraInfoTopicName", "camera_info", "the camera, below cameraName");
  }

  void read(const View& view, Hits, Rng&, Reading& reading) override {
    reading.set("image", image(camera_, view.colors(camera_, view.pose()), 3));
    set_camera_info(camera_, reading);
  }

 private:
  render::PinholeCamera camera_;
};

ANGEN_REGISTER_SENSOR(
    Camera, camera_kind(Kind("camera", "A color camera under the lamps' light.")
                            .model("camera")
                            .example("spawn camera c1 --pose \"0.8 0.8 2.2 0 0.4 0.785\""),
                        "image", "height x width x 3 bytes, sRGB"))

}  // namespace angen::sensors

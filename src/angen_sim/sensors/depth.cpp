#include "plugin/register.h"
#include "sensors/camera_params.h"

namespace angen::sensors {

/// A depth camera that looks along its x axis, z up: distances along the axis, not along the rays.
class Depth : public Sensor {
 public:
  void configure(Params& params, Wiring&) override {
    camera_ = read_camera(params);
    params.text("depthImageTopicName", "image_raw", "the depths, below cameraName");
    params.text("depthImageCameraInfoTopicName", "camera_info", "the camera, below cameraName");
    params.text("pointCloudTopicName", "points", "the points, below cameraName");
  }

  void read(const View& view, Hits, Rng&, Reading& reading) override {
    reading.set("depth", image(camera_, view.depths(camera_, view.pose()), 1));
    set_camera_info(camera_, reading);
  }

 private:
  render::PinholeCamera camera_;
};

ANGEN_REGISTER_SENSOR(Depth,
                      camera_kind(Kind("depth", "A depth camera: meters along its axis."), "depth",
                                  "height x width distances in m, NaN where nothing is"))

}  // namespace angen::sensors

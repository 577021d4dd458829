// libgazebo_ros_camera.so libgazebo_ros_multicamera.so
#include "plugin/registration.h"
#include "plugin/view.h"
#include "sensors/camera_params.h"

namespace angen::sensors {

namespace {

// Luma of sRGB values, by Rec. 601.
std::vector<std::uint8_t> gray_of(const std::vector<std::uint8_t>& colors) {
  std::vector<std::uint8_t> gray(colors.size() / 3);
  for (std::size_t i = 0; i < gray.size(); ++i) {
    gray[i] = static_cast<std::uint8_t>(
        (299 * colors[3 * i] + 587 * colors[3 * i + 1] + 114 * colors[3 * i + 2] + 500) / 1000);
  }
  return gray;
}

}  // namespace

/// A camera that looks along its x axis, z up.
class Camera : public Sensor {
 public:
  void configure(Params& params, Wiring&) override {
    lens_ = read_lens(params);
    const std::string format =
        params.text("camera/image/format", "R8G8B8", "L8 is gray, all others are colored");
    gray_ = format == "L8" || format == "L_INT8";
    params.text("imageTopicName", "image_raw", "the image, below cameraName");
    params.text("cameraInfoTopicName", "camera_info", "the camera, below cameraName");
  }

  void read(const View& view, Hits, Rng&, Reading& reading) override {
    std::vector<std::uint8_t> colors = view.colors(lens_.camera, view.pose());
    reading.set("image", gray_ ? image(lens_.camera, gray_of(colors), 1)
                               : image(lens_.camera, std::move(colors), 3));
    set_camera_info(lens_, reading);
  }

 private:
  Lens lens_;
  bool gray_ = false;
};

ANGEN_REGISTER_SENSOR(
    Camera, camera_kind(Kind("camera", "A camera under the lamps' light.")
                            .model("camera")
                            .example("spawn camera c1 --pose \"0.8 0.8 2.2 0 0.4 0.785\""),
                        "image", "height x width x 3 bytes, sRGB; x 1 of a gray one"))

}  // namespace angen::sensors

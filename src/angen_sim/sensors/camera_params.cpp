#include "sensors/camera_params.h"

#include <utility>

namespace angen::sensors {

namespace {

constexpr Range kPixels{1.0, 4096.0};
constexpr Range kAngle{1e-3, 3.1};

}  // namespace

render::PinholeCamera read_camera(Params& params) {
  render::PinholeCamera camera;
  camera.horizontal_angle = params.number("camera/horizontal_fov", camera.horizontal_angle, "rad",
                                          "full angle from left to right", kAngle);
  camera.width = params.integer("camera/image/width", camera.width, "", "pixels", kPixels);
  camera.height = params.integer("camera/image/height", camera.height, "", "pixels", kPixels);
  camera.near =
      params.number("camera/clip/near", camera.near, "m", "nearer is not seen", kPositive);
  camera.far = params.number("camera/clip/far", camera.far, "m", "farther is not seen", kPositive);
  if (camera.near > camera.far)
    throw params.error("camera/clip", "<camera/clip>: near is above far");
  params.text("cameraName", "", "topics stand below it, instead of /angen/KIND/NAME");
  return camera;
}

Kind camera_kind(Kind kind, std::string image, std::string image_doc) {
  return kind.publishes_at(30.0)
      .on_demand()
      .image(std::move(image), std::move(image_doc))
      .integer("width", "px", "of the image")
      .shown()
      .integer("height", "px", "of the image")
      .shown()
      .number("focal", "px", "focal length")
      .number("center_x", "px", "of the optical axis in the image")
      .number("center_y", "px", "of the optical axis in the image");
}

void set_camera_info(const render::PinholeCamera& camera, Reading& reading) {
  reading.set("width", camera.width);
  reading.set("height", camera.height);
  reading.set("focal", camera.focal());
  reading.set("center_x", camera.center_x());
  reading.set("center_y", camera.center_y());
}

}  // namespace angen::sensors

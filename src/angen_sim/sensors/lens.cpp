#include "sensors/lens.h"

namespace angen::sensors {

namespace {

constexpr Range kPixels{1.0, 4096.0};
constexpr Range kAngle{1e-3, 3.1};

}  // namespace

render::Lens read_lens(Params& params) {
  render::Lens lens;
  lens.horizontal_angle = params.number("camera/horizontal_fov", lens.horizontal_angle, "rad",
                                        "full angle from left to right", kAngle);
  lens.width = params.integer("camera/image/width", lens.width, "", "pixels", kPixels);
  lens.height = params.integer("camera/image/height", lens.height, "", "pixels", kPixels);
  lens.near = params.number("camera/clip/near", lens.near, "m", "nearer is not seen", kPositive);
  lens.far = params.number("camera/clip/far", lens.far, "m", "farther is not seen", kPositive);
  if (lens.near > lens.far) throw params.error("camera/clip", "<camera/clip>: near is above far");
  params.text("cameraName", "", "topics stand below it, instead of /angen/KIND/NAME");
  return lens;
}

void tell_lens(const render::Lens& lens, Reading& reading) {
  reading.set("width", lens.width);
  reading.set("height", lens.height);
  reading.set("focal", lens.focal());
  reading.set("centre_x", lens.centre_x());
  reading.set("centre_y", lens.centre_y());
}

}  // namespace angen::sensors

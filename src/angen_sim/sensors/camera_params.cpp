#include "sensors/camera_params.h"

#include <cmath>
#include <string>
#include <utility>

namespace angen::sensors {

namespace {

constexpr Range kPixels{1.0, 4096.0};
constexpr double kMaxPixels = 3840.0 * 2160.0;
constexpr double kMaxPixelsPerSecond = 30.0 * kMaxPixels;
constexpr Range kAngle{1e-3, 3.1};
constexpr Range kCoefficient{-100.0, 100.0};

// The camera's own distortion, or that of Gazebo's plug-in.
render::Distortion read_distortion(Params& params) {
  const auto coefficient = [&](const std::string& path, const char* doc) {
    return params.number(path.c_str(), 0.0, "", doc, kCoefficient);
  };
  render::Distortion lens, given;
  given.k1 = coefficient("distortionK1", "radial distortion of the lens");
  given.k2 = coefficient("distortionK2", "radial, of the fourth power");
  given.k3 = coefficient("distortionK3", "radial, of the sixth power");
  given.p1 = coefficient("distortionT1", "tangential distortion");
  given.p2 = coefficient("distortionT2", "tangential distortion");
  const std::string block = "camera/distortion/";
  lens.k1 = coefficient(block + "k1", "the same as distortionK1, which it precedes");
  lens.k2 = coefficient(block + "k2", "the same as distortionK2");
  lens.k3 = coefficient(block + "k3", "the same as distortionK3");
  lens.p1 = coefficient(block + "p1", "the same as distortionT1");
  lens.p2 = coefficient(block + "p2", "the same as distortionT2");
  const bool only = params.flag("autoDistortion", false, "leaves out distortionK1 and others");
  return only || !lens.none() ? lens : given;
}

// Parameters of Gazebo's plug-ins; here the image determines these values.
void read_unused(Params& params) {
  for (const char* path : {"Cx", "Cy", "CxPrime", "focalLength"}) {
    params.number(path, 0.0, "px", "not used: it follows from the image and its angle");
  }
  params.flag("borderCrop", true, "not used: an image has no border");
  params.text("triggerTopicName", "image_trigger", "not used: it is not triggered");
}

std::string whole_text(double number) { return std::to_string(std::llround(number)); }

// The thread that renders an image answers no call meanwhile.
void check_pixels(const render::PinholeCamera& camera, Params& params) {
  const double pixels = static_cast<double>(camera.width) * camera.height;
  if (pixels > kMaxPixels) {
    throw params.error("camera/image", "an image of " + whole_text(pixels) +
                                           " pixels, must have at most 3840 x 2160");
  }
  const double rate = pixels / to_seconds(params.update_period());
  if (rate > kMaxPixelsPerSecond) {
    throw params.error("camera/image", whole_text(rate) + " pixels a second, must be at most " +
                                           whole_text(kMaxPixelsPerSecond) +
                                           ": a smaller image, or a lower update_rate");
  }
}

}  // namespace

Lens read_lens(Params& params) {
  Lens lens;
  render::PinholeCamera& camera = lens.camera;
  camera.horizontal_angle = params.number("camera/horizontal_fov", camera.horizontal_angle, "rad",
                                          "full angle from left to right", kAngle);
  camera.width = params.integer("camera/image/width", camera.width, "", "pixels", kPixels);
  camera.height = params.integer("camera/image/height", camera.height, "", "pixels", kPixels);
  check_pixels(camera, params);
  camera.near =
      params.number("camera/clip/near", camera.near, "m", "nearer is not seen", kPositive);
  camera.far = params.number("camera/clip/far", camera.far, "m", "farther is not seen", kPositive);
  if (camera.near > camera.far)
    throw params.error("camera/clip", "<camera/clip>: near is above far");
  params.text("cameraName", "", "prefix of its topics, instead of /angen/KIND/NAME");
  camera.distortion = read_distortion(params);
  lens.baseline = params.number("hackBaseline", 0.0, "m", "to the left camera of a stereo pair");
  read_unused(params);
  return lens;
}

Kind camera_kind(Kind kind, std::string image, std::string image_doc) {
  return kind.rate(30.0)
      .on_demand()
      .image(std::move(image), std::move(image_doc))
      .integer("width", "px", "of the image")
      .shown()
      .integer("height", "px", "of the image")
      .shown()
      .number("focal", "px", "focal length")
      .number("center_x", "px", "of the optical axis in the image")
      .number("center_y", "px", "of the optical axis in the image")
      .numbers("distortion", "", "k1 k2 p1 p2 k3 of the lens")
      .number("baseline", "m", "to the left camera of a stereo pair");
}

void set_camera_info(const Lens& lens, Reading& reading) {
  const render::PinholeCamera& camera = lens.camera;
  const render::Distortion& d = camera.distortion;
  reading.set("width", camera.width);
  reading.set("height", camera.height);
  reading.set("focal", camera.focal());
  reading.set("center_x", camera.center_x());
  reading.set("center_y", camera.center_y());
  reading.set("distortion", std::vector<double>{d.k1, d.k2, d.p1, d.p2, d.k3});
  reading.set("baseline", lens.baseline);
}

}  // namespace angen::sensors

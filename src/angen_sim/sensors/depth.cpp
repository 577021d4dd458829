#include "sensors/depth.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "plugin/view.h"

namespace angen::sensors {

void Depth::configure(Params& params, Wiring&) {
  lens_ = read_lens(params);
  colored_ =
      !params
           .text("imageTopicName", "", "the image in color, below cameraName; none: there is none")
           .empty();
  nearest_ = params.number("pointCloudCutoff", colored_ ? 0.4 : 0.0, "m",
                           "nearer is not seen; 0.4 with an imageTopicName", kNotNegative);
  const double farthest = colored_ ? std::min(farthest_, lens_.camera.far) : lens_.camera.far;
  farthest_ = params.number("pointCloudCutoffMax", farthest, "m", "farther is not seen", kPositive);
  in_millimeters_ = params.flag("useDepth16UC1Format", false, "depths are 16UC1 in mm, 0: none");
  params.text("cameraInfoTopicName", "", "its camera; ir/camera_info with an imageTopicName");
  params.text("depthImageTopicName", "image_raw",
              "the depths, below cameraName; depth/image_raw with an imageTopicName");
  params.text("depthImageCameraInfoTopicName", "camera_info",
              "the camera, below cameraName; depth/camera_info with an imageTopicName");
  params.text("pointCloudTopicName", "points", "the points, below cameraName");
  params.text("reflectanceTopicName", "reflectance", "not used: it has no reflectance");
  params.text("normalsTopicName", "normals", "not used: it has no normals");
  params.integer("reduceNormals", 50, "", "not used: it has no normals");
}

void Depth::read(const View& view, Hits, Rng&, Reading& reading) {
  std::vector<std::uint8_t> colors;
  if (colored_) colors = view.colors(lens_.camera, view.pose());  // whose depths are known then
  std::vector<float> depths = view.depths(lens_.camera, view.pose());
  for (float& depth : depths) {
    const bool seen = depth > nearest_ && depth <= farthest_;
    if (!seen) depth = std::numeric_limits<float>::quiet_NaN();
  }
  reading.set("depth", image(lens_.camera, std::move(depths), 1));
  set_camera_info(lens_, reading);
  reading.set("in_millimeters", in_millimeters_);
  if (colored_) reading.set("image", image(lens_.camera, std::move(colors), 3));
}

Kind depth_kind(Kind kind) {
  return camera_kind(std::move(kind), "depth",
                     "height x width distances in m, NaN where nothing is")
      .flag("in_millimeters", "its message has whole millimeters")
      .image("image", "height x width x 3 bytes, sRGB, with an imageTopicName");
}

}  // namespace angen::sensors

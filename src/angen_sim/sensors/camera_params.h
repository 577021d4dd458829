#pragma once

#include "plugin/kind.h"
#include "plugin/params.h"
#include "plugin/reading.h"
#include "render/pinhole_camera.h"

namespace angen::sensors {

/// The lens of Gazebo's camera plug-ins, and its description in messages.
struct Lens {
  render::PinholeCamera camera;
  double baseline = 0.0;  // m, to the left camera of a stereo pair
};

/// Reads <camera>, the lens's distortion, and the topics that Gazebo's camera plug-ins name (`ros`
/// uses those).
Lens read_lens(Params& params);

/// A kind of camera: its rate, and the fields that set_camera_info() sets, after `image`.
Kind camera_kind(Kind kind, std::string image, std::string image_doc);

/// The fields of sensor_msgs/CameraInfo.
void set_camera_info(const Lens& lens, Reading& reading);

/// An image of the camera's size out of its values.
template <class T>
ImageArray<T> image(const render::PinholeCamera& camera, std::vector<T> values,
                    std::uint32_t channels) {
  return {static_cast<std::uint32_t>(camera.height), static_cast<std::uint32_t>(camera.width),
          channels, std::make_shared<const std::vector<T>>(std::move(values))};
}

}  // namespace angen::sensors

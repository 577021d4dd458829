#pragma once

#include "plugin/params.h"
#include "plugin/reading.h"
#include "render/lens.h"

namespace angen::sensors {

/// Reads <camera>, and the topics that Gazebo's camera plug-ins name (`ros` uses those).
render::Lens read_lens(Params& params);

/// What sensor_msgs/CameraInfo is made of: width, height, focal, centre_x, centre_y (pixels).
void tell_lens(const render::Lens& lens, Reading& reading);

/// An image of the lens's size out of its values.
template <class T>
Grid<T> image(const render::Lens& lens, std::vector<T> values, std::uint32_t channels) {
  return {static_cast<std::uint32_t>(lens.height), static_cast<std::uint32_t>(lens.width), channels,
          std::make_shared<const std::vector<T>>(std::move(values))};
}

}  // namespace angen::sensors

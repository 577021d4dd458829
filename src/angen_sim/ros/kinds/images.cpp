#include "ros/kinds/images.h"

#include <sensor_msgs/image_encodings.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace angen::node {
namespace {

template <class T>
void copy(const ImageArray<T>& image, const char* encoding, BulkImage& message) {
  if (!image.values) return;
  message.height = image.height;
  message.width = image.width;
  message.encoding = encoding;
  message.step = static_cast<std::uint32_t>(image.width * image.channels * sizeof(T));
  message.size = static_cast<std::uint32_t>(image.values->size() * sizeof(T));
  message.write = [values = image.values](std::uint8_t* data) {
    std::memcpy(data, values->data(), values->size() * sizeof(T));
  };
}

ImageArray<std::uint16_t> in_millimeters(const FloatImage& depth) {
  constexpr float kMax = std::numeric_limits<std::uint16_t>::max();
  std::vector<std::uint16_t> whole;
  whole.reserve(depth.values->size());
  for (const float meters : *depth.values) {
    const float millimeters = std::round(1000.0F * meters);
    const bool fits = millimeters >= 0.0F && millimeters <= kMax;
    whole.push_back(fits ? static_cast<std::uint16_t>(millimeters) : std::uint16_t{0});
  }
  return {depth.height, depth.width, 1,
          std::make_shared<const std::vector<std::uint16_t>>(std::move(whole))};
}

}  // namespace

void fill_image(const Reading& reading, const Label&, BulkImage& message) {
  namespace encodings = sensor_msgs::image_encodings;
  const auto image = reading.get<ByteImage>("image", {});
  copy(image, (image.channels == 1 ? encodings::MONO8 : encodings::RGB8).c_str(), message);
}

void fill_depth(const Reading& reading, const Label&, BulkImage& message) {
  namespace encodings = sensor_msgs::image_encodings;
  const auto depth = reading.get<FloatImage>("depth");
  if (!reading.get<bool>("in_millimeters")) {
    copy(depth, encodings::TYPE_32FC1.c_str(), message);
  } else if (depth.values) {
    copy(in_millimeters(depth), encodings::TYPE_16UC1.c_str(), message);
  }
}

void fill_camera_info(const Reading& reading, const Label&, sensor_msgs::CameraInfo& message) {
  const auto focal = reading.get<double>("focal");
  const auto center_x = reading.get<double>("center_x");
  const auto center_y = reading.get<double>("center_y");
  message.width = static_cast<std::uint32_t>(reading.get<std::int64_t>("width"));
  message.height = static_cast<std::uint32_t>(reading.get<std::int64_t>("height"));
  message.distortion_model = "plumb_bob";
  message.D = reading.get<std::vector<double>>("distortion");
  message.D.resize(5, 0.0);
  const double shift = -focal * reading.get<double>("baseline");
  message.K = {focal, 0.0, center_x, 0.0, focal, center_y, 0.0, 0.0, 1.0};
  message.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  message.P = {focal, 0.0, center_x, shift, 0.0, focal, center_y, 0.0, 0.0, 0.0, 1.0, 0.0};
}

}  // namespace angen::node

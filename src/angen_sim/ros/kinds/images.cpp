#include "ros/kinds/images.h"

#include <sensor_msgs/image_encodings.h>

#include <cstring>

namespace angen::node {
namespace {

template <class T>
void copy(const ImageArray<T>& image, const char* encoding, sensor_msgs::Image& message) {
  if (!image.values) return;
  message.height = image.height;
  message.width = image.width;
  message.encoding = encoding;
  message.step = static_cast<std::uint32_t>(image.width * image.channels * sizeof(T));
  message.data.resize(image.values->size() * sizeof(T));
  std::memcpy(message.data.data(), image.values->data(), message.data.size());
}

}  // namespace

void fill_image(const Reading& reading, const Label&, sensor_msgs::Image& message) {
  copy(reading.get<ByteImage>("image"), sensor_msgs::image_encodings::RGB8.c_str(), message);
  copy(reading.get<FloatImage>("depth"), sensor_msgs::image_encodings::TYPE_32FC1.c_str(), message);
}

void fill_camera_info(const Reading& reading, const Label&, sensor_msgs::CameraInfo& message) {
  const auto focal = reading.get<double>("focal");
  const auto center_x = reading.get<double>("center_x");
  const auto center_y = reading.get<double>("center_y");
  message.width = static_cast<std::uint32_t>(reading.get<std::int64_t>("width"));
  message.height = static_cast<std::uint32_t>(reading.get<std::int64_t>("height"));
  message.distortion_model = "plumb_bob";
  message.D.assign(5, 0.0);
  message.K = {focal, 0.0, center_x, 0.0, focal, center_y, 0.0, 0.0, 1.0};
  message.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  message.P = {focal, 0.0, center_x, 0.0, 0.0, focal, center_y, 0.0, 0.0, 0.0, 1.0, 0.0};
}

}  // namespace angen::node

#include "ros/images.h"

#include <sensor_msgs/image_encodings.h>

#include <array>
#include <cstring>

namespace angen::node {
namespace {

template <class T>
void copy(const ImageArray<T>& grid, const char* encoding, sensor_msgs::Image& message) {
  if (!grid.values) return;
  message.height = grid.height;
  message.width = grid.width;
  message.encoding = encoding;
  message.step = static_cast<std::uint32_t>(grid.width * grid.channels * sizeof(T));
  message.data.resize(grid.values->size() * sizeof(T));
  std::memcpy(message.data.data(), grid.values->data(), message.data.size());
}

}  // namespace

void fill(const Reading& reading, const Label&, sensor_msgs::Image& message) {
  copy(reading.get<ByteImage>("image"), sensor_msgs::image_encodings::RGB8.c_str(), message);
  copy(reading.get<FloatImage>("depth"), sensor_msgs::image_encodings::TYPE_32FC1.c_str(), message);
}

void fill(const Reading& reading, const Label&, sensor_msgs::CameraInfo& message) {
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

void fill(const Reading& reading, const Label&, sensor_msgs::PointCloud2& message) {
  const auto depth = reading.get<FloatImage>("depth");
  if (!depth.values) return;
  const auto focal = static_cast<float>(reading.get<double>("focal"));
  const auto center_x = static_cast<float>(reading.get<double>("center_x"));
  const auto center_y = static_cast<float>(reading.get<double>("center_y"));
  message.height = depth.height;
  message.width = depth.width;
  for (std::uint32_t i = 0; i < 3; ++i) {
    sensor_msgs::PointField field;
    field.name = std::string(1, static_cast<char>('x' + i));
    field.offset = 4 * i;
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    message.fields.push_back(std::move(field));
  }
  message.point_step = 12;
  message.row_step = message.point_step * message.width;
  message.is_dense = false;
  message.data.resize(static_cast<std::size_t>(message.row_step) * message.height);
  std::size_t at = 0;
  for (std::uint32_t row = 0; row < depth.height; ++row) {
    for (std::uint32_t column = 0; column < depth.width; ++column) {
      const float z = (*depth.values)[static_cast<std::size_t>(row) * depth.width + column];
      const std::array<float, 3> point{(static_cast<float>(column) - center_x) / focal * z,
                                       (static_cast<float>(row) - center_y) / focal * z, z};
      std::memcpy(&message.data[at], point.data(), message.point_step);
      at += message.point_step;
    }
  }
}

}  // namespace angen::node

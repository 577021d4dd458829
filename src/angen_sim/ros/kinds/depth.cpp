#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <array>
#include <cstring>

#include "ros/kinds/images.h"
#include "ros/ros_kind.h"

namespace angen::node {
namespace {

/// `depth` as one point a pixel, x y z in m; NaN where nothing is.
void fill_points(const Reading& reading, const Label&, sensor_msgs::PointCloud2& message) {
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

ANGEN_REGISTER_ROS_KIND({"depth"},
                        RosKindBuilder()
                            .message<sensor_msgs::Image>(&fill_image, "image_raw",
                                                         "depthImageTopicName")
                            .message<sensor_msgs::CameraInfo>(&fill_camera_info, "camera_info",
                                                              "depthImageCameraInfoTopicName")
                            .message<sensor_msgs::PointCloud2>(&fill_points, "points",
                                                               "pointCloudTopicName"));

}  // namespace
}  // namespace angen::node

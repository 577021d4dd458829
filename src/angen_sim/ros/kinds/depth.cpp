#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <vector>

#include "render/pinhole_camera.h"
#include "ros/kinds/images.h"
#include "ros/kinds/points.h"
#include "ros/ros_kind.h"

namespace angen::node {
namespace {

constexpr std::uint32_t kColorAt = 16;  // bytes, as PCL has it

std::uint32_t packed(const std::uint8_t* color) {
  return std::uint32_t{color[0]} << 16U | std::uint32_t{color[1]} << 8U | color[2];
}

render::Distortion distortion_of(const Reading& reading) {
  auto d = reading.get<std::vector<double>>("distortion");
  d.resize(5, 0.0);
  return {d[0], d[1], d[2], d[3], d[4]};
}

/// `depth` as one point a pixel, x y z in m, with its color where there is one; NaN where nothing
/// is.
void fill_points(const Reading& reading, const Label&, sensor_msgs::PointCloud2& message) {
  const auto depth = reading.get<FloatImage>("depth");
  if (!depth.values) return;
  const auto colors = reading.get<ByteImage>("image", {});
  const auto focal = reading.get<double>("focal");
  const auto center_x = reading.get<double>("center_x");
  const auto center_y = reading.get<double>("center_y");
  const render::Distortion lens = distortion_of(reading);
  const bool colored = colors.values && colors.values->size() == 3 * depth.values->size();
  PointWriter points =
      colored ? PointWriter(message, {{"x", 0}, {"y", 4}, {"z", 8}, {"rgb", kColorAt}}, 32,
                            depth.height, depth.width)
              : PointWriter(message, {{"x", 0}, {"y", 4}, {"z", 8}}, 12, depth.height, depth.width);
  message.is_dense = false;
  std::vector<double> across;  // of each column
  for (std::uint32_t column = 0; column < depth.width; ++column) {
    across.push_back((column - center_x) / focal);
  }
  const bool bent = !lens.none();
  for (std::uint32_t row = 0; row < depth.height; ++row) {
    const double down = (row - center_y) / focal;
    for (std::uint32_t column = 0; column < depth.width; ++column) {
      const std::size_t pixel = static_cast<std::size_t>(row) * depth.width + column;
      const float z = (*depth.values)[pixel];
      double x = across[column], y = down;
      if (bent) lens.undistort(x, y, x, y);
      points.set(0, static_cast<float>(x) * z);
      points.set(4, static_cast<float>(y) * z);
      points.set(8, z);
      if (colored) points.set(kColorAt, packed(colors.values->data() + 3 * pixel));
      points.next();
    }
  }
}

constexpr char kColor[] = "imageTopicName";  // with this parameter it is a color camera

ANGEN_REGISTER_ROS_KIND(
    {"depth", "depth_camera"},
    RosKindBuilder()
        .message<sensor_msgs::Image>(&fill_depth, "image_raw", "depthImageTopicName")
        .with(kColor, "depth/image_raw")
        .message<sensor_msgs::CameraInfo>(&fill_camera_info, "camera_info",
                                          "depthImageCameraInfoTopicName")
        .with(kColor, "depth/camera_info")
        .message<sensor_msgs::PointCloud2>(&fill_points, "points", "pointCloudTopicName")
        .message<sensor_msgs::Image>(&fill_image, "", kColor)
        .message<sensor_msgs::CameraInfo>(&fill_camera_info, "", "cameraInfoTopicName")
        .with(kColor, "ir/camera_info")
        .optical_frame());

}  // namespace
}  // namespace angen::node

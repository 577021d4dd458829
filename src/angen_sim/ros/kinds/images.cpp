// Images of cameras as messages in the optical frame (REP 103: z ahead, x right, y down).
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "render/pinhole_camera.h"
#include "ros/kinds/points.h"
#include "ros/ros_kind.h"

namespace angen::node {
namespace {

using BulkImage = Bulk<sensor_msgs::Image>;
using BulkPoints = Bulk<sensor_msgs::PointCloud2>;

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

/// `image` as rgb8, or mono8 with one channel.
void fill_image(const Reading& reading, const Label&, BulkImage& message) {
  namespace encodings = sensor_msgs::image_encodings;
  const auto image = reading.get<ByteImage>("image", {});
  copy(image, (image.channels == 1 ? encodings::MONO8 : encodings::RGB8).c_str(), message);
}

/// `depth` as 32FC1 in m, or as 16UC1 in mm where the reading says so.
void fill_depth(const Reading& reading, const Label&, BulkImage& message) {
  namespace encodings = sensor_msgs::image_encodings;
  const auto depth = reading.get<FloatImage>("depth");
  if (!reading.get<bool>("in_millimeters")) {
    copy(depth, encodings::TYPE_32FC1.c_str(), message);
  } else if (depth.values) {
    copy(in_millimeters(depth), encodings::TYPE_16UC1.c_str(), message);
  }
}

/// A pinhole with the lens's distortion; pixel centers have whole coordinates.
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

constexpr std::size_t kRowsAtOnce = 16;
constexpr std::size_t kPixelsOfAThread = 1U << 16U;  // fewer are not worth its start

struct Point {
  float x, y, z;
};

/// PCL's layout.
struct ColorPoint {
  float x, y, z, none;
  std::uint32_t color;
  std::uint32_t nothing[3];
};

/// The points of a depth image, one a pixel, x y z in m, with its color where there is one; NaN
/// where nothing is.
class Points {
 public:
  explicit Points(const Reading& reading)
      : depth_(reading.get<FloatImage>("depth")), colors_(reading.get<ByteImage>("image", {})) {
    if (!depth_.values) return;
    auto d = reading.get<std::vector<double>>("distortion");
    d.resize(5, 0.0);
    lens_ = {d[0], d[1], d[2], d[3], d[4]};
    const auto focal = reading.get<double>("focal");
    const auto center_x = reading.get<double>("center_x");
    const auto center_y = reading.get<double>("center_y");
    for (std::uint32_t i = 0; i < depth_.width; ++i) across_.push_back((i - center_x) / focal);
    for (std::uint32_t i = 0; i < depth_.height; ++i) down_.push_back((i - center_y) / focal);
  }

  bool is_empty() const { return !depth_.values; }
  bool colored() const {
    return colors_.values && colors_.values->size() == 3 * depth_.values->size();
  }
  std::uint32_t width() const { return depth_.width; }
  std::uint32_t height() const { return depth_.height; }

  /// Writes all of them, on some threads.
  void write(std::uint8_t* data) const {
    const std::size_t rows = down_.size();
    const auto parts = static_cast<int>((rows + kRowsAtOnce - 1) / kRowsAtOnce);
    const auto worth = static_cast<int>(1 + rows * across_.size() / kPixelsOfAThread);
    parallel(parts, std::min(processors(), worth), [&] {
      return [&](int part) {
        const std::size_t first = static_cast<std::size_t>(part) * kRowsAtOnce;
        for (std::size_t row = first; row < std::min(rows, first + kRowsAtOnce); ++row) {
          colored() ? write_row<ColorPoint>(row, data) : write_row<Point>(row, data);
        }
      };
    });
  }

 private:
  template <class Made>
  void write_row(std::size_t row, std::uint8_t* data) const {
    const bool bent = !lens_.none();
    std::size_t pixel = row * across_.size();
    for (std::size_t column = 0; column < across_.size(); ++column, ++pixel) {
      double x = across_[column], y = down_[row];
      if (bent) lens_.undistort(x, y, x, y);
      const float z = (*depth_.values)[pixel];
      Made made{};
      made.x = static_cast<float>(x) * z;
      made.y = static_cast<float>(y) * z;
      made.z = z;
      if constexpr (std::is_same_v<Made, ColorPoint>) {
        const std::uint8_t* color = colors_.values->data() + 3 * pixel;
        made.color = std::uint32_t{color[0]} << 16U | std::uint32_t{color[1]} << 8U | color[2];
      }
      std::memcpy(data + pixel * sizeof made, &made, sizeof made);
    }
  }

  FloatImage depth_;
  ByteImage colors_;
  render::Distortion lens_;
  std::vector<double> across_, down_;  // each column's and row's, in focal lengths
};

void fill_points(const Reading& reading, const Label&, BulkPoints& message) {
  Points points(reading);
  if (points.is_empty()) return;
  std::vector<PointField> fields{{"x", 0}, {"y", 4}, {"z", 8}};
  if (points.colored()) fields.push_back({"rgb", offsetof(ColorPoint, color)});
  describe_points(message, fields, points.colored() ? sizeof(ColorPoint) : sizeof(Point),
                  points.height(), points.width());
  message.is_dense = false;
  message.size = message.row_step * message.height;
  message.write = [points = std::move(points)](std::uint8_t* data) { points.write(data); };
}

constexpr char kColor[] = "imageTopicName";  // with this parameter it is a color camera

ANGEN_REGISTER_ROS_KIND({"depth", "depth_camera"},
                        RosKindBuilder()
                            .message<BulkImage>(&fill_depth, "image_raw", "depthImageTopicName")
                            .with(kColor, "depth/image_raw")
                            .message<sensor_msgs::CameraInfo>(&fill_camera_info, "camera_info",
                                                              "depthImageCameraInfoTopicName")
                            .with(kColor, "depth/camera_info")
                            .message<BulkPoints>(&fill_points, "points", "pointCloudTopicName")
                            .message<BulkImage>(&fill_image, "", kColor)
                            .message<sensor_msgs::CameraInfo>(&fill_camera_info, "",
                                                              "cameraInfoTopicName")
                            .with(kColor, "ir/camera_info")
                            .optical_frame());
ANGEN_REGISTER_ROS_KIND({"camera"},
                        RosKindBuilder()
                            .message<BulkImage>(&fill_image, "image_raw", "imageTopicName")
                            .message<sensor_msgs::CameraInfo>(&fill_camera_info, "camera_info",
                                                              "cameraInfoTopicName")
                            .optical_frame());

}  // namespace
}  // namespace angen::node

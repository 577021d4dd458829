#include <geometry_msgs/Point32.h>
#include <sensor_msgs/PointCloud.h>
#include <sensor_msgs/PointCloud2.h>

#include <cmath>
#include <limits>
#include <utility>

#include "ros/kinds/points.h"
#include "ros/ros_kind.h"

namespace angen::node {
namespace {

/// The rays of a scanner, and their measurements.
class Scan {
 public:
  explicit Scan(const Reading& reading)
      : ranges_(reading.get<std::vector<double>>("ranges")),
        intensities_(reading.get<std::vector<double>>("intensities")),
        angles_(reading.get<std::vector<double>>("angles")),
        columns_(static_cast<std::size_t>(reading.get<std::int64_t>("columns"))),
        rows_(static_cast<std::size_t>(reading.get<std::int64_t>("rows"))) {
    const std::size_t size = columns_ * rows_;
    if (angles_.size() != 4 || ranges_.size() != size || intensities_.size() != size) {
      columns_ = rows_ = 0;
    }
  }

  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return rows_; }
  bool hit(std::size_t column, std::size_t row) const {
    return std::isfinite(ranges_[at(column, row)]);
  }
  double intensity(std::size_t column, std::size_t row) const {
    return intensities_[at(column, row)];
  }
  geometry_msgs::Point32 point(std::size_t column, std::size_t row) const {
    const double range = ranges_[at(column, row)];
    const double left = angle(angles_[0], angles_[1], column, columns_);
    const double up = angle(angles_[2], angles_[3], row, rows_);
    geometry_msgs::Point32 point;
    point.x = static_cast<float>(range * std::cos(up) * std::cos(left));
    point.y = static_cast<float>(range * std::cos(up) * std::sin(left));
    point.z = static_cast<float>(range * std::sin(up));
    return point;
  }

 private:
  std::size_t at(std::size_t column, std::size_t row) const { return row * columns_ + column; }
  static double angle(double first, double last, std::size_t index, std::size_t count) {
    if (count == 1) return 0.5 * (first + last);
    return first + (last - first) * static_cast<double>(index) / static_cast<double>(count - 1);
  }

  std::vector<double> ranges_, intensities_, angles_;
  std::size_t columns_, rows_;
};

/// Hits only, as Gazebo's block laser has them, with a channel of intensities.
void fill_block(const Reading& reading, const Label&, sensor_msgs::PointCloud& message) {
  const Scan scan(reading);
  sensor_msgs::ChannelFloat32 intensities;
  intensities.name = "intensities";
  for (std::size_t row = 0; row < scan.rows(); ++row) {
    for (std::size_t column = 0; column < scan.columns(); ++column) {
      if (!scan.hit(column, row)) continue;
      message.points.push_back(scan.point(column, row));
      intensities.values.push_back(static_cast<float>(scan.intensity(column, row)));
    }
  }
  message.channels.push_back(std::move(intensities));
}

/// Column after column, hits only, or all if it is organized, as in velodyne_pointcloud.
/// All points are of one instant.
void fill_rings(const Reading& reading, const Label&, sensor_msgs::PointCloud2& message) {
  const Scan scan(reading);
  const bool organized = reading.get<bool>("organized");
  std::size_t count = 0;
  for (std::size_t column = 0; column < scan.columns(); ++column) {
    for (std::size_t row = 0; row < scan.rows(); ++row) {
      if (organized || scan.hit(column, row)) ++count;
    }
  }
  PointWriter points(message,
                     {{"x", 0},
                      {"y", 4},
                      {"z", 8},
                      {"intensity", 12},
                      {"ring", 16, sensor_msgs::PointField::UINT16},
                      {"time", 18}},
                     22, static_cast<std::uint32_t>(organized ? scan.columns() : 1),
                     static_cast<std::uint32_t>(organized ? scan.rows() : count));
  message.is_dense = !organized;
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t column = 0; column < scan.columns(); ++column) {
    for (std::size_t row = 0; row < scan.rows(); ++row) {
      const bool hit = scan.hit(column, row);
      if (!hit && !organized) continue;
      const geometry_msgs::Point32 point = scan.point(column, row);
      points.set(0, hit ? point.x : kNone);
      points.set(4, hit ? point.y : kNone);
      points.set(8, hit ? point.z : kNone);
      points.set(12, static_cast<float>(scan.intensity(column, row)));
      points.set(16, static_cast<std::uint16_t>(row));
      points.set(18, 0.0F);
      points.next();
    }
  }
}

ANGEN_REGISTER_ROS_KIND({"block_laser"},
                        RosKindBuilder().message<sensor_msgs::PointCloud>(&fill_block));
ANGEN_REGISTER_ROS_KIND({"velodyne"}, RosKindBuilder().named_message<sensor_msgs::PointCloud2>(
                                          &fill_rings, "velodyne_points"));

}  // namespace
}  // namespace angen::node

#include <gtest/gtest.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "angen_sim/ros/messages.h"
#include "ros/topics.h"

namespace angen::node {
namespace {

template <class T>
ImageArray<T> image_of(std::uint32_t height, std::uint32_t width, std::uint32_t channels,
                       std::vector<T> values) {
  return {height, width, channels, std::make_shared<const std::vector<T>>(std::move(values))};
}

Reading lens() {
  Reading reading;
  reading.set("width", 3);
  reading.set("height", 2);
  reading.set("focal", 2.0);
  reading.set("center_x", 1.0);
  reading.set("center_y", 0.5);
  return reading;
}

float number_at(const std::vector<std::uint8_t>& data, std::size_t byte) {
  float value = 0.0F;
  std::memcpy(&value, &data.at(byte), sizeof value);
  return value;
}

TEST(Vision, AMissIsInfiniteInALaserScan) {
  Reading reading;
  reading.set("ranges", std::vector<double>{1.5, std::numeric_limits<double>::infinity()});
  reading.set("angle_min", -0.5);
  reading.set("angle_max", 0.5);
  reading.set("angle_increment", 1.0);
  reading.set("scan_time", 0.1);
  reading.set("range_min", 0.2);
  reading.set("range_max", 8.0);
  sensor_msgs::LaserScan scan;
  fill("lidar", reading, {}, scan);
  ASSERT_EQ(scan.ranges.size(), 2U);
  EXPECT_EQ(scan.ranges[0], 1.5F);
  EXPECT_EQ(scan.ranges[1], std::numeric_limits<float>::infinity());
  EXPECT_EQ(scan.angle_min, -0.5F);
  EXPECT_EQ(scan.angle_max, 0.5F);
  EXPECT_EQ(scan.angle_increment, 1.0F);
  EXPECT_EQ(scan.scan_time, 0.1F);
  EXPECT_EQ(scan.range_min, 0.2F);
  EXPECT_EQ(scan.range_max, 8.0F);
}

TEST(Vision, AnImageIsRgb8RowByRow) {
  Reading reading = lens();
  reading.set("image", image_of<std::uint8_t>(1, 2, 3, {1, 2, 3, 4, 5, 6}));
  sensor_msgs::Image image;
  fill("camera", reading, {}, image);
  EXPECT_EQ(image.encoding, "rgb8");
  EXPECT_EQ(image.height, 1U);
  EXPECT_EQ(image.width, 2U);
  EXPECT_EQ(image.step, 6U);
  EXPECT_EQ(image.data, (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6}));
}

TEST(Vision, DepthIs32FC1) {
  Reading reading = lens();
  reading.set("depth", image_of<float>(2, 1, 1, {1.5F, 2.5F}));
  sensor_msgs::Image image;
  fill("camera", reading, {}, image);
  EXPECT_EQ(image.encoding, "32FC1");
  EXPECT_EQ(image.step, 4U);
  EXPECT_EQ(number_at(image.data, 4), 2.5F);
}

TEST(Vision, CameraInfoIsThePinhole) {
  sensor_msgs::CameraInfo info;
  fill("camera", lens(), {}, info);
  EXPECT_EQ(info.width, 3U);
  EXPECT_EQ(info.height, 2U);
  EXPECT_EQ(info.K[0], 2.0);
  EXPECT_EQ(info.K[2], 1.0);
  EXPECT_EQ(info.K[4], 2.0);
  EXPECT_EQ(info.K[5], 0.5);
  EXPECT_EQ(info.P[0], 2.0);
  EXPECT_EQ(info.P[6], 0.5);
  EXPECT_EQ(info.P[10], 1.0);
}

TEST(Vision, APointLiesWhereItsPixelLooks) {
  Reading reading = lens();
  reading.set("depth", image_of<float>(2, 3, 1, {4, 4, 4, 4, 4, std::nanf("")}));
  sensor_msgs::PointCloud2 cloud;
  fill("depth", reading, {}, cloud);
  ASSERT_EQ(cloud.data.size(), 6U * 12U);
  EXPECT_EQ(cloud.row_step, 36U);
  // Lower left pixel (0, 1): left of the axis by 1 pixel, below it by half of one.
  EXPECT_FLOAT_EQ(number_at(cloud.data, 36), -2.0F);
  EXPECT_FLOAT_EQ(number_at(cloud.data, 40), 1.0F);
  EXPECT_FLOAT_EQ(number_at(cloud.data, 44), 4.0F);
  EXPECT_TRUE(std::isnan(number_at(cloud.data, 5 * 12 + 8)));
}

sim::SensorEntry sensor(const std::string& kind,
                        const std::vector<std::pair<std::string, std::string>>& parameters = {}) {
  sim::SensorEntry entry;
  entry.kind = kind;
  entry.name = "it";
  auto described = std::make_shared<desc::Sensor>();
  for (const auto& [key, value] : parameters) {
    Element child;
    child.name = key;
    child.text = value;
    described->plugin_element.children.push_back(child);
    if (key == "topicName") entry.topic = value;
  }
  entry.desc = described;
  return entry;
}

using Topics = std::vector<std::string>;

TEST(Vision, ASensorByItselfIsHeardUnderItsKindAndName) {
  EXPECT_EQ(sensor_topics(sensor("lidar"), format_of("lidar"), nullptr), Topics{"/angen/lidar/it"});
  const std::vector<Format>& formats = formats_of("depth");
  ASSERT_EQ(formats.size(), 3U);
  EXPECT_EQ(sensor_topics(sensor("depth"), formats[2], nullptr), Topics{"/angen/depth/it/points"});
}

TEST(Vision, ARobotsTopicsStandBelowItsNameAndTheFirstOnesAlsoAlone) {
  Robot robot;
  robot.name = "r2";
  const sim::SensorEntry scan = sensor("lidar", {{"topicName", "scan"}});
  EXPECT_EQ(sensor_topics(scan, format_of("lidar"), &robot), Topics{"/r2/scan"});
  robot.first = true;
  EXPECT_EQ(sensor_topics(scan, format_of("lidar"), &robot), (Topics{"/r2/scan", "/scan"}));
}

TEST(Vision, CamerasTakeGazebosTopicNames) {
  Robot robot;
  robot.name = "r2";
  const sim::SensorEntry camera =
      sensor("camera", {{"cameraName", "camera"}, {"imageTopicName", "rgb/image_raw"}});
  const std::vector<Format>& formats = formats_of("camera");
  EXPECT_EQ(sensor_topics(camera, formats[0], &robot), Topics{"/r2/camera/rgb/image_raw"});
  EXPECT_EQ(sensor_topics(camera, formats[1], &robot), Topics{"/r2/camera/camera_info"});
}

}  // namespace
}  // namespace angen::node

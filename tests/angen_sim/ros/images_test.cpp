#include <gtest/gtest.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud.h>
#include <sensor_msgs/PointCloud2.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "angen_sim/ros/messages.h"

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
  reading.set("distortion", std::vector<double>(5, 0.0));
  reading.set("baseline", 0.0);
  reading.set("in_millimeters", false);
  return reading;
}

float number_at(const std::vector<std::uint8_t>& data, std::size_t byte) {
  float value = 0.0F;
  std::memcpy(&value, &data.at(byte), sizeof value);
  return value;
}

TEST(Images, AnImageIsRgb8RowByRow) {
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

TEST(Images, DepthIs32FC1) {
  Reading reading = lens();
  reading.set("depth", image_of<float>(2, 1, 1, {1.5F, 2.5F}));
  sensor_msgs::Image image;
  fill("depth", reading, {}, image);
  EXPECT_EQ(image.encoding, "32FC1");
  EXPECT_EQ(image.step, 4U);
  EXPECT_EQ(number_at(image.data, 4), 2.5F);
}

TEST(Images, CameraInfoIsThePinhole) {
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

TEST(Images, APointLiesOnTheRayOfItsPixel) {
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

TEST(Images, AGrayImageIsMono8) {
  Reading reading = lens();
  reading.set("image", image_of<std::uint8_t>(1, 2, 1, {1, 2}));
  sensor_msgs::Image image;
  fill("camera", reading, {}, image);
  EXPECT_EQ(image.encoding, "mono8");
  EXPECT_EQ(image.step, 2U);
}

TEST(Images, DepthInMillimetersIs16UC1WithZeroForNone) {
  Reading reading = lens();
  reading.set("depth", image_of<float>(1, 3, 1, {1.2345F, std::nanf(""), 70.0F}));
  reading.set("in_millimeters", true);
  sensor_msgs::Image image;
  fill("depth_camera", reading, {}, image);
  EXPECT_EQ(image.encoding, "16UC1");
  EXPECT_EQ(image.step, 6U);
  std::array<std::uint16_t, 3> values{};
  std::memcpy(values.data(), image.data.data(), sizeof values);
  EXPECT_EQ(values, (std::array<std::uint16_t, 3>{1235, 0, 0}));
}

TEST(Images, CameraInfoHasTheLensAndTheBaseline) {
  Reading reading = lens();
  reading.set("distortion", std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5});
  reading.set("baseline", 0.07);
  sensor_msgs::CameraInfo info;
  fill("camera", reading, {}, info);
  EXPECT_EQ(info.D, (std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5}));
  EXPECT_EQ(info.P[3], -2.0 * 0.07);
}

TEST(Images, PointsOfAColorCameraHaveTheirColor) {
  Reading reading = lens();
  reading.set("depth", image_of<float>(1, 2, 1, {1.0F, 2.0F}));
  reading.set("image", image_of<std::uint8_t>(1, 2, 3, {1, 2, 3, 4, 5, 6}));
  sensor_msgs::PointCloud2 cloud;
  fill("depth", reading, {}, cloud);
  EXPECT_EQ(cloud.point_step, 32U);
  ASSERT_EQ(cloud.fields.size(), 4U);
  EXPECT_EQ(cloud.fields[3].name, "rgb");
  std::uint32_t packed = 0;
  std::memcpy(&packed, &cloud.data.at(32 + cloud.fields[3].offset), sizeof packed);
  EXPECT_EQ(packed, 0x040506U);
  EXPECT_EQ(number_at(cloud.data, 32 + 8), 2.0F);
}

Reading scan() {  // 2 columns at -90 and 90 degrees, 3 rows at -45, 0 and 45
  const double none = std::numeric_limits<double>::infinity();
  Reading reading;
  reading.set("ranges", std::vector<double>{2.0, none, 1.0, 3.0, none, 4.0});
  reading.set("intensities", std::vector<double>{10.0, 0.0, 20.0, 30.0, 0.0, 40.0});
  reading.set("columns", 2);
  reading.set("rows", 3);
  reading.set("angles", std::vector<double>{-M_PI_2, M_PI_2, -M_PI_4, M_PI_4});
  reading.set("organized", false);
  return reading;
}

TEST(Images, ABlockLaserHasItsHitsWithIntensities) {
  sensor_msgs::PointCloud cloud;
  fill("block_laser", scan(), {}, cloud);
  ASSERT_EQ(cloud.points.size(), 4U);
  EXPECT_NEAR(cloud.points[0].y, -std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(cloud.points[0].z, -std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(cloud.points[2].y, 3.0, 1e-6);
  ASSERT_EQ(cloud.channels.size(), 1U);
  EXPECT_EQ(cloud.channels[0].values, (std::vector<float>{10, 20, 30, 40}));
}

TEST(Images, AVelodyneHasRingsAndMayHaveAPlaceForEachRay) {
  Reading reading = scan();
  sensor_msgs::PointCloud2 cloud;
  fill("velodyne", reading, {}, cloud);
  EXPECT_EQ(cloud.height, 1U);
  EXPECT_EQ(cloud.width, 4U);
  EXPECT_TRUE(cloud.is_dense);
  std::vector<std::string> names;
  for (const sensor_msgs::PointField& field : cloud.fields) names.push_back(field.name);
  EXPECT_EQ(names, (std::vector<std::string>{"x", "y", "z", "intensity", "ring", "time"}));
  const auto ring_of = [&](std::size_t point) {
    std::uint16_t ring = 0;
    std::memcpy(&ring, &cloud.data.at(point * cloud.point_step + cloud.fields[4].offset), 2);
    return ring;
  };
  EXPECT_EQ(ring_of(0), 0);  // column after column
  EXPECT_EQ(ring_of(1), 1);
  EXPECT_EQ(ring_of(3), 2);
  EXPECT_NEAR(number_at(cloud.data, cloud.point_step + 4), -1.0, 1e-6);
  reading.set("organized", true);
  sensor_msgs::PointCloud2 organized;
  fill("velodyne", reading, {}, organized);
  EXPECT_EQ(organized.height, 2U);
  EXPECT_EQ(organized.width, 3U);
  EXPECT_TRUE(std::isnan(number_at(organized.data, 2 * organized.point_step)));
}

}  // namespace
}  // namespace angen::node

#include <gtest/gtest.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <cmath>
#include <cstring>
#include <memory>
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
  fill("camera", reading, {}, image);
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

}  // namespace
}  // namespace angen::node

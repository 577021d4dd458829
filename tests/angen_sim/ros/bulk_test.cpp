#include "ros/bulk.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace angen::node {
namespace {

const std::vector<std::uint8_t> kData{7, 8, 9, 10, 11, 12, 13};

template <class Message>
Bulk<Message> in_bulk(const Message& message) {
  Bulk<Message> bulk;
  static_cast<Message&>(bulk) = message;
  bulk.data.clear();
  bulk.size = static_cast<std::uint32_t>(message.data.size());
  bulk.write = [data = message.data](std::uint8_t* to) {
    std::memcpy(to, data.data(), data.size());
  };
  return bulk;
}

template <class Message>
std::vector<std::uint8_t> bytes_of(const Message& message) {
  const ros::SerializedMessage made = ros::serialization::serializeMessage(message);
  return {made.buf.get(), made.buf.get() + made.num_bytes};
}

// The oracle is roscpp's own serialization of the message.
template <class Message>
void expect_same_on_the_wire(const Message& message) {
  EXPECT_EQ(bytes_of(in_bulk(message)), bytes_of(message));
  EXPECT_STREQ(ros::message_traits::md5sum<Bulk<Message>>(),
               ros::message_traits::md5sum<Message>());
  EXPECT_STREQ(ros::message_traits::datatype<Bulk<Message>>(),
               ros::message_traits::datatype<Message>());
}

TEST(Bulk, AnImageIsThatOfRoscpp) {
  sensor_msgs::Image image;
  image.header.frame_id = "lens";
  image.encoding = "mono8";
  image.height = 1;
  image.width = image.step = 7;
  expect_same_on_the_wire(image);  // without data
  image.data = kData;
  expect_same_on_the_wire(image);
}

TEST(Bulk, ACloudHasWhatFollowsItsData) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.frame_id = "lens";
  cloud.fields.resize(2);
  cloud.fields[0].name = "x";
  cloud.data = kData;
  for (const bool dense : {false, true}) {
    cloud.is_dense = dense;
    expect_same_on_the_wire(cloud);
  }
}

}  // namespace
}  // namespace angen::node

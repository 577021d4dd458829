#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <cstdint>
#include <cstring>
#include <functional>

namespace angen::node {

/// A message whose `data`, megabytes of it, is written once: to where it is serialized. On the wire
/// it is a Message.
template <class Message>
struct Bulk : Message {
  std::uint32_t size = 0;                      // bytes of `data`, which stays empty
  std::function<void(std::uint8_t*)> write{};  // writes all of them
};

/// The bytes of a message after its data.
inline std::uint32_t bytes_after_data(const sensor_msgs::Image&) { return 0; }
inline std::uint32_t bytes_after_data(const sensor_msgs::PointCloud2&) { return 1; }  // is_dense

}  // namespace angen::node

namespace ros {
namespace message_traits {

template <class Message>
struct HasHeader<angen::node::Bulk<Message>> : HasHeader<Message> {};
template <class Message>
struct MD5Sum<angen::node::Bulk<Message>> : MD5Sum<Message> {};
template <class Message>
struct DataType<angen::node::Bulk<Message>> : DataType<Message> {};
template <class Message>
struct Definition<angen::node::Bulk<Message>> : Definition<Message> {};

}  // namespace message_traits

namespace serialization {

template <class Message>
struct Serializer<angen::node::Bulk<Message>> {
  static std::uint32_t serializedLength(const angen::node::Bulk<Message>& bulk) {
    return serializationLength<Message>(bulk) + bulk.size;
  }
  /// Serializes the message without data, and moves what follows the data to its place.
  static void write(OStream& stream, const angen::node::Bulk<Message>& bulk) {
    const std::uint32_t after = angen::node::bytes_after_data(bulk);
    OStream rest(stream.getData(), stream.getLength());
    serialize<Message>(rest, bulk);
    std::uint8_t* const end = rest.getData() - after;
    std::memmove(end + bulk.size, end, after);
    OStream size(end - sizeof bulk.size, sizeof bulk.size);
    size.next(bulk.size);
    if (bulk.size > 0) bulk.write(end);
    stream.advance(serializedLength(bulk));
  }
};

}  // namespace serialization
}  // namespace ros

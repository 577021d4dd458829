#pragma once

#include <sensor_msgs/PointCloud2.h>

#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace angen::node {

struct PointField {
  const char* name;
  std::uint32_t offset;  // bytes
  std::uint8_t type = sensor_msgs::PointField::FLOAT32;
};

/// Sets all but the points of a message.
inline void describe_points(sensor_msgs::PointCloud2& message,
                            const std::vector<PointField>& fields, std::uint32_t bytes,
                            std::uint32_t height, std::uint32_t width) {
  for (const PointField& field : fields) {
    sensor_msgs::PointField made;
    made.name = field.name;
    made.offset = field.offset;
    made.datatype = field.type;
    made.count = 1;
    message.fields.push_back(std::move(made));
  }
  message.height = height;
  message.width = width;
  message.point_step = bytes;
  message.row_step = bytes * width;
}

/// Points of a message, one after the other.
class PointWriter {
 public:
  /// Describes the fields of a message and makes room for its points.
  PointWriter(sensor_msgs::PointCloud2& message, const std::vector<PointField>& fields,
              std::uint32_t bytes, std::uint32_t height, std::uint32_t width) {
    describe_points(message, fields, bytes, height, width);
    message.data.resize(static_cast<std::size_t>(message.row_step) * height);
    at_ = message.data.data();
    step_ = bytes;
  }

  /// Sets a field of the present point, of which there is one.
  template <class T>
  void set(std::uint32_t offset, T value) {
    std::memcpy(at_ + offset, &value, sizeof value);
  }
  void next() { at_ += step_; }

 private:
  std::uint8_t* at_ = nullptr;
  std::uint32_t step_ = 0;
};

}  // namespace angen::node

#pragma once

#include <stdexcept>

#include "ros/ros_kind.h"

namespace angen::node {

/// Fills in the message of that type that is registered for the kind.
template <class Message>
void fill(const std::string& kind, const Reading& reading, const Label& label, Message& message) {
  for (const Format& format : ros_kind(kind).formats) {
    if (format.type == ros::message_traits::datatype<Message>()) {
      format.fill(reading, label, &message);
      return;
    }
  }
  throw std::logic_error(kind + " has no such message");
}

inline const std::vector<Format>& formats_of(const std::string& kind) {
  return ros_kind(kind).formats;
}
inline const Format& format_of(const std::string& kind) { return formats_of(kind).front(); }

}  // namespace angen::node

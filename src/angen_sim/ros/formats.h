#pragma once

#include <ros/advertise_options.h>
#include <ros/publisher.h>

#include <string>
#include <vector>

#include "plugin/reading.h"

namespace angen::node {

/// What a message says besides the reading: whose it is.
struct Label {
  std::string name;
  std::string frame;  // header.frame_id
};

/// The message that one kind of reading or state becomes.
struct Format {
  std::string type;  // angen_msgs/PirMsg
  /// Of a kind that has several: the end of the topic, and the parameter that says otherwise.
  std::string leaf;
  std::string leaf_parameter;
  ros::AdvertiseOptions (*advertise)(const std::string& topic, std::uint32_t queue,
                                     const ros::SubscriberStatusCallback& joined,
                                     const ros::SubscriberStatusCallback& left);
  void (*publish)(const ros::Publisher& publisher, const Reading& reading, Nanoseconds stamp,
                  const Label& label);
};

/// The one table: built-in kinds have messages of their own, any other goes out as
/// angen_msgs/Reading. Never empty.
const std::vector<Format>& formats_of(const std::string& kind);

/// The first of them.
const Format& format_of(const std::string& kind);

}  // namespace angen::node

#pragma once

#include <ros/node_handle.h>

#include <memory>
#include <string>
#include <vector>

#include "plugin/reading.h"

namespace angen::node {

/// What a message says besides the reading: whose it is.
struct Label {
  std::string name;
  std::string frame;  // header.frame_id
};

/// A reading on its way to a topic.
struct Parcel {
  std::shared_ptr<const Reading> reading;
  Nanoseconds stamp = 0;
  std::shared_ptr<const Label> label;
};

/// A topic of one sensor or device, or of several. It makes messages only for those who listen.
class Channel {
 public:
  virtual ~Channel() = default;
  virtual bool has_subscribers() const = 0;
  virtual void put(const Parcel& parcel) = 0;
  /// Whether what is put waits for flush(), which sends all of it in one message.
  virtual bool collects() const { return false; }
  virtual void flush(Nanoseconds) {}
};

/// The message that one kind of reading or state becomes.
struct Format {
  using Open = std::unique_ptr<Channel> (*)(ros::NodeHandle& node, const std::string& topic);

  std::string type;  // angen_msgs/PirMsg
  /// Of a kind that has several: the end of the topic, and the parameter that says otherwise.
  std::string leaf;
  std::string leaf_parameter;
  Open open = nullptr;     // a message for each reading; throws what roscpp throws
  Open latched = nullptr;  // the same for states: the last stays
  std::string array_type;  // angen_msgs/PirArray, or empty: there is none
  Open array = nullptr;    // a message for all readings between two flushes
};

/// The one table: built-in kinds have messages of their own, any other goes out as
/// angen_msgs/Reading. Never empty.
const std::vector<Format>& formats_of(const std::string& kind);

/// The first of them.
const Format& format_of(const std::string& kind);

}  // namespace angen::node

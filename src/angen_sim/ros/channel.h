#pragma once

#include <ros/console.h>
#include <ros/node_handle.h>

#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "plugin/reading.h"
#include "ros/convert.h"
#include "ros/lazy_publisher.h"

/// Topics of sensors and devices, by type of message.
namespace angen::node {

/// The rest of a message, besides the reading.
struct Label {
  std::string name;   // name of the sensor or device
  std::string frame;  // header.frame_id
};

/// A reading on its way to a topic.
struct StampedReading {
  std::shared_ptr<const Reading> reading;
  Nanoseconds stamp = 0;
  std::shared_ptr<const Label> label;
};

/// A topic of one sensor or device, or of several. Messages are made for subscribers only.
class Channel {
 public:
  virtual ~Channel() = default;
  virtual bool has_subscribers() const = 0;
  virtual void publish(const StampedReading& reading) = 0;
  /// Whether readings wait for flush(), which publishes all of them in one message.
  virtual bool batches() const { return false; }
  virtual void flush(Nanoseconds) {}
};

/// Fills in a message's fields but its header.
template <class Message>
using Fill = void (*)(const Reading& reading, const Label& label, Message& message);

template <class Message>
Message to_message(const StampedReading& reading, Fill<Message> fill) {
  Message message;
  message.header.stamp = to_ros(reading.stamp);
  message.header.frame_id = reading.label->frame;
  try {
    fill(*reading.reading, *reading.label, message);
  } catch (const Error& error) {                          // thrown by Reading::get()
    if (reading.reading->find(kErrorField) == nullptr) {  // an event says that it has failed
      ROS_ERROR_THROTTLE(10.0, "the message of %s is incomplete: %s", reading.label->name.c_str(),
                         error.what());
    }
  }
  return message;
}

/// The number of messages that wait for a slow subscriber; fewer for pictures, of megabytes each.
template <class Message>
std::uint32_t queue_length() {
  const std::string type = ros::message_traits::datatype<Message>();
  return type == "sensor_msgs/Image" || type == "sensor_msgs/PointCloud2" ? 4 : 20;
}

/// A message for each reading.
template <class Message>
class EachChannel : public Channel {
 public:
  EachChannel(ros::NodeHandle& node, const std::string& topic, Fill<Message> fill)
      : publisher_(LazyPublisher::of<Message>(node, topic, queue_length<Message>())), fill_(fill) {}
  bool has_subscribers() const override { return publisher_.has_subscribers(); }
  void publish(const StampedReading& reading) override {
    publisher_.publish([&] { return to_message<Message>(reading, fill_); });
  }

 private:
  LazyPublisher publisher_;
  Fill<Message> fill_;
};

/// A message for each state; the last one is latched.
template <class Message>
class LatchedChannel : public Channel {
 public:
  LatchedChannel(ros::NodeHandle& node, const std::string& topic, Fill<Message> fill)
      : publisher_(node, topic, kQueue), fill_(fill) {}
  bool has_subscribers() const override { return true; }
  void publish(const StampedReading& reading) override {
    if (reading.reading == last_) return;
    last_ = reading.reading;
    publisher_.set([reading, fill = fill_] { return to_message<Message>(reading, fill); });
  }

 private:
  static constexpr std::uint32_t kQueue = 100;  // a second of a moving door's states

  LatchedLazyPublisher<Message> publisher_;
  Fill<Message> fill_;
  std::shared_ptr<const Reading> last_;
};

/// One message for some readings: `Array` has names and readings.
template <class Array, class Message>
Array collect(const std::vector<StampedReading>& readings, Nanoseconds now, Fill<Message> fill) {
  Array array;
  array.header.stamp = to_ros(now);
  array.names.reserve(readings.size());
  array.readings.reserve(readings.size());
  for (const StampedReading& reading : readings) {
    array.names.push_back(reading.label->name);
    array.readings.push_back(to_message<Message>(reading, fill));
  }
  return array;
}

/// One message for all readings between two flushes.
template <class Array, class Message>
class BatchChannel : public Channel {
 public:
  BatchChannel(ros::NodeHandle& node, const std::string& topic, Fill<Message> fill)
      : publisher_(LazyPublisher::of<Array>(node, topic, kQueue)), fill_(fill) {}
  bool has_subscribers() const override { return publisher_.has_subscribers(); }
  bool batches() const override { return true; }
  void publish(const StampedReading& reading) override {
    if (has_subscribers()) pending_.push_back(reading);
  }
  void flush(Nanoseconds now) override {
    if (pending_.empty()) return;
    publisher_.publish([&] { return collect<Array>(pending_, now, fill_); });
    pending_.clear();
  }

 private:
  static constexpr std::uint32_t kQueue = 20;

  LazyPublisher publisher_;
  Fill<Message> fill_;
  std::vector<StampedReading> pending_;
};

/// The last states of devices. Any thread.
class LastStates {
 public:
  /// False where it is the one before. It is removed with the last owner of its label.
  bool add(const StampedReading& state) {
    const std::lock_guard<std::mutex> lock(mutex_);
    State& last = states_[state.label->name];
    const bool is_new = last.reading != state.reading || last.label.expired();
    last = {state.reading, state.stamp, state.label};
    return is_new;
  }
  void forget_gone() {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (auto at = states_.begin(); at != states_.end();) {
      at = at->second.label.expired() ? states_.erase(at) : std::next(at);
    }
  }
  std::vector<StampedReading> all() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<StampedReading> found;
    found.reserve(states_.size());
    for (const auto& [name, state] : states_) {
      if (auto label = state.label.lock()) found.push_back({state.reading, state.stamp, label});
    }
    return found;
  }

 private:
  struct State {
    std::shared_ptr<const Reading> reading;
    Nanoseconds stamp = 0;
    std::weak_ptr<const Label> label;
  };

  mutable std::mutex mutex_;
  std::map<std::string, State> states_;  // by name
};

/// One message for all states that changed between two flushes; a newcomer gets the last of each
/// device that is there.
template <class Array, class Message>
class LatchedBatchChannel : public Channel {
 public:
  LatchedBatchChannel(ros::NodeHandle& node, const std::string& topic, Fill<Message> fill)
      : publisher_(node, topic, kQueue), fill_(fill) {}
  bool has_subscribers() const override { return true; }
  bool batches() const override { return true; }
  void publish(const StampedReading& state) override {
    if (last_->add(state)) pending_.push_back(state);
  }
  void flush(Nanoseconds now) override {
    if (pending_.empty()) return;
    last_->forget_gone();
    publisher_.set(
        [last = last_, now, fill = fill_] { return collect<Array>(last->all(), now, fill); },
        false);
    publisher_.publish([&] { return collect<Array>(pending_, now, fill_); });
    pending_.clear();
  }

 private:
  static constexpr std::uint32_t kQueue = 100;  // like LatchedChannel's

  LatchedLazyPublisher<Array> publisher_;
  Fill<Message> fill_;
  std::shared_ptr<LastStates> last_ = std::make_shared<LastStates>();
  std::vector<StampedReading> pending_;
};

}  // namespace angen::node

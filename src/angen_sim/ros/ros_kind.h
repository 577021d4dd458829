#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <std_msgs/ColorRGBA.h>

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ros/bulk.h"
#include "ros/by_name.h"
#include "ros/channel.h"
#include "ros/command_topic.h"

/// The ROS side of a kind of sensor or device: its messages, its frame, the messages that command
/// it, and how rviz shows it. ros/kinds/ has these of the built-in kinds; a plug-in library libX.so
/// brings its own in libX_ros.so beside it. No other C++ of the node names a kind.
namespace angen::node {

/// The message that readings or states of one kind become.
struct Format {
  using Open = std::function<std::unique_ptr<Channel>(ros::NodeHandle&, const std::string& topic)>;

  std::string type;  // angen_msgs/PirMsg
  /// In a kind with several messages: the end of the topic, and the parameter that changes it.
  std::string leaf;  // empty: it is not published where the parameter is not given
  std::string leaf_parameter;
  std::string other_leaf;       // instead of `leaf` where this parameter is given
  std::string other_leaf_with;  // empty: never
  bool leaf_alone = false;      // it is the topic, below <robotNamespace>; not the end of one
  std::string topic;            // one topic for all sensors: /tf
  std::string off_switch;       // a parameter that is false if it is not published
  Open open;                    // a message for each reading; may throw exceptions of roscpp
  Open latched;                 // the same for states, the last of them latched
  std::string array_type;       // angen_msgs/PirArray, or empty: there is none
  Open array;                   // one message for all readings between two flushes
  Open latched_array;           // the same for states; a newcomer gets the last of each device
  /// Fills in a message of that type: for tests, and for uses without a topic.
  std::function<void(const Reading&, const Label&, void* message)> fill;
};

/// Display of a sensor's rays in rviz; their lengths are its field `ranges`.
struct RayStyle {
  std::string group;          // rviz namespace
  std_msgs::ColorRGBA alarm;  // while an alarm of its kind is yes
};

struct RosKind {
  /// The frame of a sensor's messages.
  using Frame = std::function<std::string(const sim::SensorEntry&)>;

  /// Messages that say where a robot is in their frame.
  struct Odometry {
    std::string base;              // the frame that moves
    bool starts_at_model = false;  // 0 is where the robot was put, instead of the world's origin
  };

  std::vector<Format> formats;   // the first is the one to name; at least one
  std::optional<RayStyle> rays;  // none: rviz shows no rays
  bool caption = false;          // rviz shows its summary over it
  std::string label;             // rviz namespace of a label with a device's name; empty: none
  Frame frame;                   // null: one of its own, or <frameName>
  bool is_camera = false;        // its frame is optical (REP 103)
  std::function<Odometry(const sim::SensorEntry&)> odometry;  // null: its messages are none
  Frame truth;                             // its messages are the pose of that link; null: none
  bool is_robot = false;                   // a drive with the frames and topics of a Robot
  std::vector<CommandTopicRule> commands;  // a device's, by type of message; a robot has one
  /// Whether something else publishes a sensor's messages; null: never.
  std::function<bool(const sim::SensorEntry&)> published_elsewhere;
};

/// Builds a RosKind: `message` for each message, then the rest. Without a message it publishes
/// angen_msgs/Reading; without a `fill` a message's fields have the names of its reading's.
class RosKindBuilder {
 public:
  template <class Message>
  RosKindBuilder& message(Fill<Message> fill = &fill_by_name<Message>, std::string leaf = "",
                          std::string leaf_parameter = "") {
    Format format;
    format.type = ros::message_traits::datatype<Message>();
    format.leaf = std::move(leaf);
    format.leaf_parameter = std::move(leaf_parameter);
    format.open = opener<EachChannel<Message>>(fill);
    format.latched = opener<LatchedChannel<Message>>(fill);
    format.fill = [fill](const Reading& reading, const Label& label, void* made) {
      fill_in(fill, reading, label, made);
    };
    kind_.formats.push_back(std::move(format));
    return *this;
  }

  /// A message whose topic a parameter names, as Gazebo's plug-ins do.
  template <class Message>
  RosKindBuilder& named_message(Fill<Message> fill, std::string fallback,
                                std::string parameter = "topicName") {
    message<Message>(fill, std::move(fallback), std::move(parameter));
    kind_.formats.back().leaf_alone = true;
    return *this;
  }

  /// A channel that makes messages of readings by itself, on this topic of the robot.
  template <class Message, class Made>
  RosKindBuilder& channel(std::string topic) {
    Format format;
    format.type = ros::message_traits::datatype<Message>();
    format.leaf = std::move(topic);
    format.leaf_alone = true;
    format.open = [](ros::NodeHandle& node, const std::string& name) {
      return std::make_unique<Made>(node, name);
    };
    kind_.formats.push_back(std::move(format));
    return *this;
  }

  /// The last message's topic ends otherwise where the parameter is given.
  RosKindBuilder& with(std::string parameter, std::string leaf) {
    kind_.formats.back().other_leaf_with = std::move(parameter);
    kind_.formats.back().other_leaf = std::move(leaf);
    return *this;
  }

  /// A transform for each reading, on /tf, unless the parameter is false.
  RosKindBuilder& transform(Fill<geometry_msgs::TransformStamped> fill, std::string off_switch);

  /// A message of a kind with up to thousands of instances: with topics:=kind they share a topic.
  template <class Message, class Array>
  RosKindBuilder& message_with_array(Fill<Message> fill = &fill_by_name<Message>) {
    message<Message>(fill);
    kind_.formats.back().array_type = ros::message_traits::datatype<Array>();
    kind_.formats.back().array = opener<BatchChannel<Array, Message>>(fill);
    kind_.formats.back().latched_array = opener<LatchedBatchChannel<Array, Message>>(fill);
    return *this;
  }

  /// Rays are drawn of a kind that has Kind::ray_color, in its color or, while it alarms, in this.
  RosKindBuilder& rays(std::string group, std_msgs::ColorRGBA alarm) {
    return set(kind_.rays, RayStyle{std::move(group), alarm});
  }
  RosKindBuilder& caption() { return set(kind_.caption, true); }

  /// The frame of its messages, which robots made for Gazebo know: the node does not place it.
  RosKindBuilder& frame(RosKind::Frame frame) { return set(kind_.frame, std::move(frame)); }
  RosKindBuilder& optical_frame() { return set(kind_.is_camera, true); }
  /// Its messages are the odometry of a robot, in that frame.
  RosKindBuilder& odometry(RosKind::Frame in, RosKind::Odometry (*of)(const sim::SensorEntry&)) {
    kind_.odometry = of;
    return frame(std::move(in));
  }
  /// Its messages are the true pose of the link of that name; "" is its own.
  RosKindBuilder& truth(RosKind::Frame link) { return set(kind_.truth, std::move(link)); }
  RosKindBuilder& published_elsewhere(std::function<bool(const sim::SensorEntry&)> where) {
    return set(kind_.published_elsewhere, std::move(where));
  }

  /// A drive that Angen's own robots have: its messages are odometry, in frames and on topics of
  /// its Robot, and so are those that command it.
  template <class Message>
  RosKindBuilder& robot(Command (*make)(const Message&)) {
    kind_.is_robot = true;
    return commanded_by(make, nullptr);
  }
  /// Messages that command a device, on these topics; there may be several types of them.
  template <class Message>
  RosKindBuilder& commanded_by(Command (*make)(const Message&), CommandTopicRule::Topics topics) {
    kind_.commands.push_back({subscribe_as(make), std::move(topics)});
    return *this;
  }
  /// Messages that command a device, on the topic that a parameter of its <plugin> names.
  template <class Message>
  RosKindBuilder& commanded_by(Command (*make)(const Message&), std::string parameter,
                               std::string fallback) {
    return commanded_by(make, topics_by_parameter(std::move(parameter), std::move(fallback)));
  }

  /// rviz shows its name over its model.
  RosKindBuilder& label(std::string group) { return set(kind_.label, std::move(group)); }

  RosKind done();

 private:
  template <class Member, class Value>
  RosKindBuilder& set(Member& member, Value&& value) {
    member = std::forward<Value>(value);
    return *this;
  }
  template <class Message>
  static void fill_in(Fill<Message> fill, const Reading& reading, const Label& label, void* made) {
    fill(reading, label, *static_cast<Message*>(made));
  }
  template <class Message>
  static void fill_in(Fill<Bulk<Message>> fill, const Reading& reading, const Label& label,
                      void* made) {
    Bulk<Message> bulk;
    fill(reading, label, bulk);
    bulk.data.resize(bulk.size);
    if (bulk.size > 0) bulk.write(bulk.data.data());
    *static_cast<Message*>(made) = std::move(bulk);
  }

  template <class Kind, class Message>
  static Format::Open opener(Fill<Message> fill) {
    return [fill](ros::NodeHandle& node, const std::string& topic) {
      return std::make_unique<Kind>(node, topic, fill);
    };
  }

  RosKind kind_;
};

/// A static object of this type, in the library that knows the messages, registers kinds.
struct RosKindRegistration {
  RosKindRegistration(const std::vector<std::string>& kinds, RosKindBuilder builder);
};

#define ANGEN_REGISTER_ROS_KIND(...) ANGEN_REGISTER_ROS_KIND_HOP(__COUNTER__, __VA_ARGS__)
#define ANGEN_REGISTER_ROS_KIND_HOP(Number, ...) ANGEN_REGISTER_ROS_KIND_AS(Number, __VA_ARGS__)
#define ANGEN_REGISTER_ROS_KIND_AS(Number, ...)                  \
  [[maybe_unused]] static const angen::node::RosKindRegistration \
      angen_ros_kind_registration_##Number(__VA_ARGS__)

/// Loads libX_ros.so for the plug-in library libX.so, where there is one on the plug-in path. Once
/// for each; any thread.
void load_ros_library(const std::string& library);

/// The registration of a kind; angen_msgs/Reading for an unregistered one. `library` is
/// the plug-in's, as its SDF names it: libX_ros.so is loaded if it exists. Any thread; the
/// result lives as long as the process.
const RosKind& ros_kind(const std::string& kind, const std::string& library = "");

inline const RosKind& ros_kind(const sim::SensorEntry& sensor) {
  return ros_kind(sensor.kind, sensor.desc ? sensor.desc->plugin : "");
}
inline const RosKind& ros_kind(const sim::DeviceEntry& device) {
  return ros_kind(device.kind, device.library);
}

}  // namespace angen::node

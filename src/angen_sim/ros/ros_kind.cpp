#include "ros/ros_kind.h"

#include <angen_msgs/Reading.h>
#include <angen_msgs/ReadingArray.h>
#include <dlfcn.h>
#include <ros/console.h>
#include <tf2_msgs/TFMessage.h>

#include <map>
#include <mutex>
#include <set>
#include <type_traits>

#include "plugin/library.h"
#include "ros/robots.h"

namespace angen::node {
namespace {

struct Registry {
  std::mutex mutex;  // guards kinds
  std::map<std::string, RosKind> kinds;
  std::mutex loading;           // guards tried
  std::set<std::string> tried;  // libraries
};

// A function's static: registrations of other files come before main().
Registry& registry() {
  static Registry all;
  return all;
}

/// Any reading: flags and counts as numbers, an array as NAME[0], NAME[1], …
void fill_any(const Reading& reading, const Label& label, angen_msgs::Reading& message) {
  message.name = label.name;
  message.kind = reading.kind;
  const auto number = [&](const std::string& name, double value) {
    message.names.push_back(name);
    message.values.push_back(value);
  };
  const auto text = [&](const std::string& name, const std::string& value) {
    message.text_names.push_back(name);
    message.texts.push_back(value);
  };
  const auto each = [](const std::string& name, const auto& values, const auto& add) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      add(name + "[" + std::to_string(i) + "]", values[i]);
    }
  };
  for (const auto& [name, value] : reading.fields) {
    std::visit(
        [&, &field = name](const auto& held) {
          using T = std::decay_t<decltype(held)>;
          if constexpr (std::is_arithmetic_v<T>) {
            number(field, static_cast<double>(held));
          } else if constexpr (std::is_same_v<T, std::string>) {
            text(field, held);
          } else if constexpr (std::is_same_v<T, Choice>) {
            text(field, held.name);
          } else if constexpr (std::is_same_v<T, std::vector<double>>) {
            each(field, held, number);
          } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
            each(field, held, text);
          }
        },
        value);
  }
}

/// Transforms for readings, on /tf.
class TransformChannel : public Channel {
 public:
  TransformChannel(ros::NodeHandle& node, const std::string& topic,
                   Fill<geometry_msgs::TransformStamped> fill)
      : publisher_(LazyPublisher::of<tf2_msgs::TFMessage>(node, topic, kQueue)), fill_(fill) {}
  bool has_subscribers() const override { return publisher_.has_subscribers(); }
  void publish(const StampedReading& reading) override {
    publisher_.publish([&] {
      tf2_msgs::TFMessage message;
      message.transforms.push_back(to_message<geometry_msgs::TransformStamped>(reading, fill_));
      return message;
    });
  }

 private:
  static constexpr std::uint32_t kQueue = 100;

  LazyPublisher publisher_;
  Fill<geometry_msgs::TransformStamped> fill_;
};

const RosKind* find(const std::string& kind) {
  const std::lock_guard<std::mutex> lock(registry().mutex);
  const auto found = registry().kinds.find(kind);
  return found == registry().kinds.end() ? nullptr : &found->second;
}

}  // namespace

RosKindBuilder& RosKindBuilder::transform(Fill<geometry_msgs::TransformStamped> fill,
                                          std::string off_switch) {
  Format format;
  format.type = ros::message_traits::datatype<tf2_msgs::TFMessage>();
  format.topic = "tf";
  format.off_switch = std::move(off_switch);
  format.open = format.latched = opener<TransformChannel>(fill);
  format.fill = [fill](const Reading& reading, const Label& label, void* made) {
    auto& message = *static_cast<tf2_msgs::TFMessage*>(made);
    message.transforms.emplace_back();
    fill(reading, label, message.transforms.back());
  };
  kind_.formats.push_back(std::move(format));
  return *this;
}

RosKind RosKindBuilder::done() {
  if (kind_.formats.empty()) {
    message_with_array<angen_msgs::Reading, angen_msgs::ReadingArray>(&fill_any).caption();
  }
  return std::move(kind_);
}

RosKindRegistration::RosKindRegistration(const std::vector<std::string>& kinds,
                                         RosKindBuilder builder) {
  const RosKind kind = builder.done();
  const std::lock_guard<std::mutex> lock(registry().mutex);
  for (const std::string& name : kinds) registry().kinds.emplace(name, kind);
}

void load_ros_library(const std::string& library) {
  // Held while it loads: no other thread takes a kind for one without a message meanwhile.
  const std::lock_guard<std::mutex> lock(registry().loading);
  const std::size_t suffix = library.rfind(".so");
  if (suffix == std::string::npos || !registry().tried.insert(library).second) return;
  const std::string file = find_library(library.substr(0, suffix) + "_ros.so");
  if (file.empty()) return;
  if (dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE) == nullptr) {
    ROS_WARN("%s does not load, its kinds have no messages: %s", file.c_str(), dlerror());
  }
}

const RosKind& ros_kind(const std::string& kind, const std::string& library) {
  static const RosKind generic = RosKindBuilder().done();
  if (const RosKind* found = find(kind)) return *found;
  load_ros_library(library);
  const RosKind* found = find(kind);
  return found != nullptr ? *found : generic;
}

}  // namespace angen::node

#pragma once

#include <ros/node_handle.h>

#include <atomic>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ros/formats.h"
#include "ros/frames.h"
#include "sim/simulation.h"

namespace angen::node {

/// Who listens, counted by the connect callbacks: asking a publisher costs as much as publishing.
struct Listeners {
  std::atomic<int> count{0};
  std::atomic<std::uint64_t> joined{0};  // grows with each newcomer
};

/// A publisher that knows whether anybody listens.
class Outlet {
 public:
  Outlet() = default;
  /// Throws what roscpp throws for a topic it does not take.
  Outlet(ros::NodeHandle& node, const Format& format, const std::string& topic, bool latch,
         std::uint32_t queue);

  template <class Message>
  static Outlet of(ros::NodeHandle& node, const std::string& topic, bool latch,
                   std::uint32_t queue) {
    Outlet outlet;
    ros::AdvertiseOptions options;
    options.init<Message>(topic, queue, outlet.on_join(), outlet.on_leave());
    options.latch = latch;
    outlet.publisher_ = node.advertise(options);
    return outlet;
  }

  bool heard() const { return listeners_->count.load(std::memory_order_relaxed) > 0; }
  std::uint64_t joined() const { return listeners_->joined.load(std::memory_order_relaxed); }
  bool works() const { return static_cast<bool>(publisher_); }
  const ros::Publisher& publisher() const { return publisher_; }

 private:
  ros::SubscriberStatusCallback on_join() const;
  ros::SubscriberStatusCallback on_leave() const;

  std::shared_ptr<Listeners> listeners_ = std::make_shared<Listeners>();
  ros::Publisher publisher_;
};

/// The topics of all sensors and devices, kept equal to what exists.
class Publishers {
 public:
  Publishers(ros::NodeHandle& node, sim::Simulation& simulation)
      : node_(node), simulation_(simulation) {}

  /// Advertises and shuts down as `structure` differs from the last one. `frames` and `robots` are
  /// those of the same structure.
  void follow(const sim::Snapshot& snapshot, const FrameTree& frames,
              const std::vector<Robot>& robots);

  /// Sends what is new in this tick.
  void pass(const sim::Snapshot& snapshot);

 private:
  struct Channel {
    Outlet outlet;
    std::shared_ptr<const Reading> sent;  // of a state: what is latched
    const Format* format = nullptr;
  };
  struct Source {
    Label label;
    std::vector<std::shared_ptr<Channel>> channels;
  };
  using Key = std::pair<std::string, std::string>;  // topic, type
  using Channels = std::map<Key, std::shared_ptr<Channel>>;

  // A sensor that looks on demand only.
  struct Costly {
    std::uint32_t sensor = 0;  // in Structure::sensors
    bool wanted = false;
  };

  void attach(Source& source, const Format& format, const std::string& topic, bool latch,
              Channels& kept);
  void ask_for(const sim::Structure& structure);
  void send_state(const sim::Snapshot& snapshot, std::uint32_t device);
  void repeat_odometry(const sim::Snapshot& snapshot);

  ros::NodeHandle& node_;
  sim::Simulation& simulation_;
  Channels channels_;
  std::vector<Source> sensors_;  // as Structure::sensors
  std::vector<Source> devices_;  // as Structure::devices
  std::vector<Costly> costly_;
  std::vector<std::uint32_t> robots_;  // indices of drives
  Nanoseconds odometry_slot_ = 0;
};

}  // namespace angen::node

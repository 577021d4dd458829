#pragma once

#include <ros/node_handle.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ros/readings.h"
#include "ros/ros_kind.h"
#include "ros/topics.h"
#include "sim/simulation.h"
#include "tf/frames.h"

namespace angen::node {

/// The topics of all sensors and devices that exist.
class Publishers {
 public:
  Publishers(ros::NodeHandle& node, sim::Simulation& simulation, Topics topics, Readings& readings)
      : node_(node), simulation_(simulation), topics_(topics), readings_(readings) {}

  /// Advertises and shuts down by `changes` since the last structure. `frames` and `robots`
  /// are those of the snapshot's.
  void on_structure(const sim::Snapshot& snapshot, const FrameTree& frames,
                    const std::vector<Robot>& robots, const Changes& changes);

  /// Publishes the readings and states of this tick.
  void publish(const sim::Snapshot& snapshot);

 private:
  struct Source {
    std::shared_ptr<const Label> label;
    std::vector<std::shared_ptr<Channel>> channels;
    std::string robot;  // below whose name its topics are; see space_of()
  };
  using Key = std::pair<std::string, std::string>;  // topic, type
  using Channels = std::map<Key, std::shared_ptr<Channel>>;

  // A sensor that samples on demand only.
  struct OnDemand {
    std::uint32_t sensor = 0;  // in Structure::sensors
    bool requested = false;
    bool is_camera = false;
  };

  void attach(Source& source, const std::string& type, const Format::Open& open,
              const std::string& topic);
  Source sensor_source(const sim::SensorEntry& entry, const Label& label, const Robot* robot);
  Source device_source(const sim::DeviceEntry& entry);
  void follow_sensors(const sim::Structure& structure, const FrameTree& frames,
                      const std::vector<Robot>& robots, const Numbers& numbers);
  std::vector<Source> device_sources(const sim::Structure& structure,
                                     const std::vector<Robot>& robots, const Numbers& numbers);
  void shut_down_unused();
  void list_on_demand(const sim::Structure& structure);
  void request(const sim::Structure& structure);
  void prepare_for_images();
  void publish_state(const sim::Snapshot& snapshot, std::uint32_t device);
  void repeat_odometry(const sim::Snapshot& snapshot);
  bool is_robot(std::uint32_t device) const {
    return std::binary_search(robots_.begin(), robots_.end(), device);
  }

  ros::NodeHandle& node_;
  sim::Simulation& simulation_;
  Topics topics_;
  Readings& readings_;
  Channels channels_;
  std::vector<std::shared_ptr<Channel>> batched_;  // channels that flush
  std::vector<Source> sensors_;                    // indexed like Structure::sensors
  std::vector<Source> devices_;                    // indexed like Structure::devices
  std::vector<OnDemand> on_demand_;
  bool expects_images_ = false;
  std::vector<std::uint32_t> robots_;  // their devices, ascending
  Nanoseconds odometry_slot_ = 0;
};

}  // namespace angen::node

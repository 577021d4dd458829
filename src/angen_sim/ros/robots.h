#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/snapshot.h"

/// Models with a drive, and their topics and frames.
namespace angen::node {

/// A drive's frames and topics, as its SDF names them.
struct Robot {
  std::uint32_t device = 0;  // in Structure::devices
  std::uint32_t model = 0;
  std::uint32_t base = 0;  // its base link, in Structure::links
  std::string name;
  bool first = false;
  std::string odom_frame;  // `odom`; of a further robot NAME/odom
  std::string base_frame;
  std::vector<std::string> command_topics;  // a first robot's also without NAME/
  std::vector<std::string> odometry_topics;
};

/// Every drive, the first of them first. `world_plugins` serve robots that have no plug-in of their
/// own.
std::vector<Robot> find_robots(const sim::Structure& structure,
                               const std::vector<desc::Plugin>& world_plugins);

/// The topics for a robot's `requested` one: one that starts with / is itself; others are under
/// the robot's name, and the first robot's also without it.
std::vector<std::string> robot_topics(const Robot& robot, const std::string& requested);

/// The robot that model number `model` is, or null.
const Robot* robot_in(const std::vector<Robot>& robots, std::uint32_t model);

/// The text of the first child `key` that one of the elements has.
std::string value_of(const std::vector<const Element*>& elements, const std::string& key,
                     const std::string& fallback);

}  // namespace angen::node

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/snapshot.h"

/// The tree of coordinate frames, worked out once for each structure.
namespace angen::node {

/// What a drive's SDF says of ROS.
struct Robot {
  std::uint32_t device = 0;  // in Structure::devices
  std::uint32_t model = 0;
  std::uint32_t base = 0;  // its base link, in Structure::links
  std::string name;
  bool first = false;
  std::string odom_frame;  // `odom`; of a further robot NAME/odom
  std::string base_frame;
  std::vector<std::string> command_topics;  // of a first robot also without NAME/
  std::vector<std::string> odometry_topics;
};

/// Every drive, the first of them first. `world_plugins` serve robots that have no plug-in of their
/// own.
std::vector<Robot> find_robots(const sim::Structure& structure,
                               const std::vector<desc::Plugin>& world_plugins);

/// Where a robot's `requested` topic is: one that starts with / means itself; others stand under
/// the robot's name, and the first robot's also without it.
std::vector<std::string> robot_topics(const Robot& robot, const std::string& requested);

/// The robot that model number `model` is, or null.
const Robot* robot_in(const std::vector<Robot>& robots, std::uint32_t model);

struct FixedFrame {
  std::string parent;
  std::string child;
  Pose pose;  // of the child in the parent
};

struct MovingFrame {
  std::string parent;
  std::string child;
  std::uint32_t link = 0;                    // Structure::links
  std::optional<std::uint32_t> parent_link;  // none: the world
};

struct FrameTree {
  std::vector<FixedFrame> fixed;
  std::vector<MovingFrame> moving;
  std::vector<std::string> sensors;    // frame of each sensor, as Structure::sensors
  std::vector<std::int32_t> moved_by;  // for each link the index in `moving` that carries it, or -1
};

/// `world` is the root. Links that fixed joints hold together hang on the first of them; a robot's
/// hang on its base, whose own place under its odometry frame is its odometry's business, not this
/// tree's. Odometry frames stand in the world, unless a localization places them.
FrameTree make_frames(const sim::Snapshot& snapshot, const std::vector<Robot>& robots,
                      bool odometry_in_world = true);

}  // namespace angen::node

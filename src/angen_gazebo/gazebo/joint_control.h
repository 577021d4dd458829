#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "ros/changes.h"
#include "sim/simulation.h"

/// Controllers of joints that run in the node between its ticks, as those of ros_control do. The
/// library libX_ros.so beside a plug-in libX.so of kind `joint_command` brings them.
namespace angen::node {

struct ControlledJoint {
  std::string name;
  std::string interface;  // what its commands set: position, velocity or effort
  double position = 0.0;  // rad or m
  double velocity = 0.0;  // rad/s or m/s, in the last tick
  double effort = 0.0;    // N m or N, as its device reported last
  double command = std::numeric_limits<double>::quiet_NaN();  // the last one; NaN: none
};

/// The joints that a <plugin>'s transmissions drive, each once.
std::vector<ControlledJoint> driven_joints(const Element& plugin);

/// The controllers of one robot.
class JointControl {
 public:
  virtual ~JointControl() = default;
  /// Called after each tick. The commands that it sets are carried out with the next one.
  virtual void update(Nanoseconds time, std::vector<ControlledJoint>& joints) = 0;
};

/// Makes those of a <plugin>, for names below `space`. Throws roscpp's exceptions.
using MakeJointControl = std::function<std::unique_ptr<JointControl>(
    const Element& plugin, const std::string& space, const std::vector<ControlledJoint>& joints)>;

/// A static object of this type, in libX_ros.so, registers them for a plug-in library libX.so.
struct JointControlRegistration {
  JointControlRegistration(const std::string& library, MakeJointControl make);
};

/// Whether a library's joints have controllers. Any thread.
bool has_joint_control(const std::string& library);

/// The namespace of a robot that has this <plugin>, not yet a graph name.
std::string control_space(const Element& plugin, const std::string& model);

/// Runs the controllers of all robots. Their commands are queued like all others.
class JointControls {
 public:
  explicit JointControls(sim::Simulation& simulation) : simulation_(simulation) {}

  void on_structure(const sim::Structure& structure, const Changes& changes);
  void update(const sim::Snapshot& snapshot);
  bool empty() const { return robots_.empty(); }

 private:
  struct Robot {
    std::uint32_t model = 0;  // in Structure::models
    std::vector<ControlledJoint> joints;
    std::vector<std::uint32_t> entries;  // each joint's index in Structure::joints
    std::vector<std::uint32_t> devices;  // the devices that command them, in Structure::devices
    std::unique_ptr<JointControl> control;
  };
  static void find_parts(const sim::Structure& structure, Robot& robot);
  void post_changes(const sim::Structure& structure, const Robot& robot,
                    const std::vector<ControlledJoint>& before);

  sim::Simulation& simulation_;
  std::vector<Robot> robots_;
  Nanoseconds time_ = -1;  // time of the last update
};

}  // namespace angen::node

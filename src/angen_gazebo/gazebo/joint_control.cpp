#include "gazebo/joint_control.h"

#include <ros/console.h>
#include <std_msgs/Float64.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <mutex>
#include <utility>

#include "core/lists.h"
#include "core/named.h"
#include "ros/kinds/joint_states.h"
#include "ros/topics.h"
#include "ros/wire.h"

namespace angen::node {
namespace {

constexpr const char* kCommanded = "joint_command";   // the kind of its devices
constexpr const char* kStates = "controlled_joints";  // and of its sensor
constexpr std::uint32_t kNowhere = UINT32_MAX;

struct Makers {
  std::mutex mutex;
  std::map<std::string, MakeJointControl> all;  // by the plug-in's library
};

// A function's static: registrations of other files come before main().
Makers& makers() {
  static Makers known;
  return known;
}

MakeJointControl maker_of(const std::string& library) {
  load_ros_library(library);
  const std::lock_guard<std::mutex> lock(makers().mutex);
  const auto found = makers().all.find(library);
  return found == makers().all.end() ? MakeJointControl() : found->second;
}

// The plug-in that controllers come with; null: none does.
const desc::Plugin* plugin_of(const desc::Model& model) {
  const auto found =
      std::find_if(model.plugins.begin(), model.plugins.end(),
                   [](const desc::Plugin& plugin) { return has_joint_control(plugin.filename); });
  return found == model.plugins.end() ? nullptr : &*found;
}

std::unique_ptr<JointControl> make_control(const desc::Model& model,
                                           const std::vector<ControlledJoint>& joints) {
  const desc::Plugin& plugin = *plugin_of(model);
  try {
    return maker_of(plugin.filename)(plugin.element,
                                     graph_name(control_space(plugin.element, model.name)), joints);
  } catch (const std::exception& error) {
    ROS_WARN("%s runs without its controllers: %s", model.name.c_str(), error.what());
    return nullptr;
  }
}

// One line for each model that has come whose joints have no controllers.
void warn_without_control(const sim::Structure& structure, const Changes& changes) {
  std::uint32_t last = kNowhere;
  for (const sim::DeviceEntry& device : structure.devices) {
    if (device.kind != kCommanded || device.model == last) continue;  // a world's light has none
    const bool came = changes.models.before[device.model] == Numbers::kNone;
    if (!came || has_joint_control(device.library)) continue;
    last = device.model;
    ROS_WARN(
        "%s: controllers of ros_control are not run here: each joint takes std_msgs/Float64 on "
        "JOINT_position_controller/command (or velocity, effort) below its namespace; for "
        "controllers clone ros-controls/ros_control and ros-controls/ros_controllers and build "
        "the package gazebo_ros_control with them, as docs/controllers.md says",
        structure.models[device.model]->name.c_str());
  }
}

// The topics of ros_control's usual controllers, where these do not run.
std::vector<std::string> controller_topics(const sim::Structure& structure,
                                           const sim::DeviceEntry& device) {
  if (has_joint_control(device.library)) return {};
  const desc::Model& model = *structure.models[device.model];
  for (const desc::Plugin& plugin : model.plugins) {
    if (plugin.filename != device.library) continue;
    const std::string space = control_space(plugin.element, model.name);
    for (const ControlledJoint& joint : driven_joints(plugin.element)) {
      if (device.name != model.name + "_" + joint.name) continue;
      const std::string topic = joint.name + "_" + joint.interface + "_controller/command";
      return {graph_name(space + "/" + topic)};
    }
  }
  return {};
}

Command of_number(const std_msgs::Float64& number) { return command_of({number.data}); }

bool is_published_by_controller(const sim::SensorEntry& states) {
  return has_joint_control(states.desc->plugin);
}

ANGEN_REGISTER_ROS_KIND({kCommanded},
                        RosKindBuilder().commanded_by(&of_number, &controller_topics));
ANGEN_REGISTER_ROS_KIND({kStates}, joint_states().published_elsewhere(&is_published_by_controller));

// A reset makes devices forget earlier commands.
bool was_reset(const sim::Snapshot& snapshot) {
  return std::any_of(snapshot.events.begin(), snapshot.events.end(), [](const sim::Event& event) {
    return event.kind == "world" && event.event == "reset";
  });
}

}  // namespace

JointControlRegistration::JointControlRegistration(const std::string& library,
                                                   MakeJointControl make) {
  const std::lock_guard<std::mutex> lock(makers().mutex);
  makers().all.emplace(library, std::move(make));
}

bool has_joint_control(const std::string& library) { return maker_of(library) != nullptr; }

std::string control_space(const Element& plugin, const std::string& model) {
  const Element* space = namespace_of(plugin);
  return in_namespace(space == nullptr ? model : space->text);
}

std::vector<ControlledJoint> driven_joints(const Element& plugin) {
  std::vector<ControlledJoint> joints;
  for (const Element& transmission : plugin.children) {
    const std::string name = transmission.child_text("joint");
    if (transmission.name != "transmission" || index_in(joints, name)) continue;
    const std::string words = transmission.child_text("hardwareInterface");
    joints.emplace_back();
    joints.back().name = name;
    joints.back().interface = words.find("Effort") != std::string::npos     ? "effort"
                              : words.find("Velocity") != std::string::npos ? "velocity"
                                                                            : "position";
  }
  return joints;
}

// Indices change with each structure. A joint that no device commands is left out.
void JointControls::find_parts(const sim::Structure& structure, Robot& robot) {
  const desc::Model& model = *structure.models[robot.model];
  robot.entries.clear();
  robot.devices.clear();
  std::vector<ControlledJoint> found;
  for (ControlledJoint& joint : robot.joints) {
    const auto entry = index_in(structure.joints, model.name + "::" + joint.name);
    const auto device = std::find_if(
        structure.devices.begin(), structure.devices.end(), [&](const sim::DeviceEntry& each) {
          return each.model == robot.model && each.kind == kCommanded &&
                 each.name == model.name + "_" + joint.name;
        });
    if (!entry || device == structure.devices.end()) continue;
    robot.entries.push_back(*entry);
    robot.devices.push_back(static_cast<std::uint32_t>(device - structure.devices.begin()));
    found.push_back(std::move(joint));
  }
  robot.joints = std::move(found);
}

void JointControls::on_structure(const sim::Structure& structure, const Changes& changes) {
  warn_without_control(structure, changes);
  std::vector<Robot> before = std::exchange(robots_, {});
  for (std::uint32_t i = 0; i < structure.models.size(); ++i) {
    const desc::Plugin* plugin = plugin_of(*structure.models[i]);
    if (plugin == nullptr) continue;
    Robot robot;
    const auto old = std::find_if(before.begin(), before.end(), [&](const Robot& each) {
      return each.model == changes.models.before[i];
    });
    if (old != before.end()) robot = std::move(*old);
    if (old == before.end()) robot.joints = driven_joints(plugin->element);
    robot.model = i;
    find_parts(structure, robot);
    robots_.push_back(std::move(robot));
  }
  before.clear();  // services of removed robots end before others of their names begin
  for (Robot& robot : robots_) {
    if (robot.control == nullptr)
      robot.control = make_control(*structure.models[robot.model], robot.joints);
  }
  erase_if(robots_, [](const Robot& robot) { return robot.control == nullptr; });
}

void JointControls::post_changes(const sim::Structure& structure, const Robot& robot,
                                 const std::vector<ControlledJoint>& before) {
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const double command = robot.joints[i].command;
    if (!std::isfinite(command) || command == before[i].command) continue;
    const std::string& name = structure.devices[robot.devices[i]].name;
    simulation_.post(sim::ToDevice{kCommanded, name, {"", {command}, "", 0.0}});
  }
}

void JointControls::update(const sim::Snapshot& snapshot) {
  const double passed = to_seconds(snapshot.time - time_);
  if (passed == 0.0) return;
  for (Robot& robot : robots_) {
    bool works = true;
    for (std::size_t i = 0; i < robot.joints.size(); ++i) {
      ControlledJoint& joint = robot.joints[i];
      const double was = std::exchange(joint.position, snapshot.joint_positions[robot.entries[i]]);
      joint.velocity = passed > 0.0 && time_ >= 0 ? (joint.position - was) / passed : 0.0;
      const std::shared_ptr<const Reading>& state = snapshot.devices[robot.devices[i]];
      joint.effort = state == nullptr ? 0.0 : state->get<double>("effort", 0.0);
      works = works && (state == nullptr || state->find("error") == nullptr);
      if (was_reset(snapshot)) joint.command = ControlledJoint().command;
    }
    if (!works) continue;  // a device that has failed takes no commands
    const std::vector<ControlledJoint> before = robot.joints;
    robot.control->update(snapshot.time, robot.joints);
    post_changes(*snapshot.structure, robot, before);
  }
  time_ = snapshot.time;
}

}  // namespace angen::node

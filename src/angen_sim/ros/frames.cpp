#include "ros/frames.h"

#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "ros/wire.h"

namespace angen::node {
namespace {

constexpr char kWorld[] = "world";

// REP 103: images are seen along z, with x to the right.
const Quat kOptical = from_rpy(-M_PI_2, 0.0, -M_PI_2);

bool is_odometry(const std::string& kind) {
  return kind == "odometry" || kind == "planar_odometry" || kind == "skid_steer_odometry";
}

bool is_camera(const sim::SensorEntry& sensor) {
  return sensor.kind == "camera" || sensor.kind == "depth";
}

std::string link_frame(const sim::Structure& structure, std::uint32_t link) {
  const sim::LinkEntry& entry = structure.links[link];
  const desc::Model& model = *structure.models[entry.model];
  return model.name + "/" + model.links[entry.link].name;
}

// Links that fixed joints hold together, by the smallest index of each group; 0 is the world.
class Clusters {
 public:
  explicit Clusters(const sim::Structure& structure) : parent_(structure.links.size() + 1) {
    std::iota(parent_.begin(), parent_.end(), 0U);
    std::map<std::pair<std::uint32_t, std::string>, std::uint32_t> by_name;
    for (std::uint32_t i = 0; i < structure.links.size(); ++i) {
      const sim::LinkEntry& entry = structure.links[i];
      by_name[{entry.model, structure.models[entry.model]->links[entry.link].name}] = i + 1;
      if (!entry.moves) join(i + 1, 0);
    }
    for (std::uint32_t m = 0; m < structure.models.size(); ++m) {
      for (const desc::Joint& joint : structure.models[m]->joints) {
        if (joint.type != desc::Joint::Type::kFixed) continue;
        const auto child = by_name.find({m, joint.child});
        const auto parent = by_name.find({m, joint.parent});
        if (child == by_name.end()) continue;
        if (parent == by_name.end() && joint.parent != kWorld) continue;
        join(child->second, joint.parent == kWorld ? 0 : parent->second);
      }
    }
  }

  bool in_world(std::uint32_t link) { return root(link + 1) == 0; }
  std::uint32_t first(std::uint32_t link) { return root(link + 1) - 1; }

 private:
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  std::vector<std::uint32_t> parent_;
};

std::string value_of(const std::vector<const Element*>& elements, const std::string& key,
                     const std::string& fallback) {
  for (const Element* element : elements) {
    if (const Element* found = element->child(key)) return found->text;
  }
  return fallback;
}

// The frame of what a sensor of a robot made for Gazebo publishes, which others know: nobody here
// says where it is. None for other sensors.
std::optional<std::string> foreign_frame(const sim::SensorEntry& sensor, const desc::Model& model) {
  static const std::set<std::string> states = {"joint_states", "wheel_states"};
  static const std::set<std::string> bodies = {"imu", "imu_sensor"};
  if (states.count(sensor.kind) != 0) return "";
  if (is_odometry(sensor.kind))
    return value_of({&sensor.desc->plugin_element}, "odometryFrame", "odom");
  if (sensor.kind == "p3d") return sensor.frame.empty() ? kWorld : sensor.frame;
  if (bodies.count(sensor.kind) != 0 && sensor.frame.empty()) {
    return value_of({&sensor.desc->plugin_element}, "bodyName", sensor.name);
  }
  if (sensor.frame.empty() || (!model.tolerant && bodies.count(sensor.kind) == 0)) {
    return std::nullopt;
  }
  return sensor.frame;
}

class Builder {
 public:
  Builder(const sim::Snapshot& snapshot, const std::vector<Robot>& robots, bool odometry_in_world)
      : snapshot_(snapshot),
        structure_(*snapshot.structure),
        odometry_in_world_(odometry_in_world),
        clusters_(structure_) {
    frames_.resize(structure_.links.size());
    for (const Robot& robot : robots) robot_of_[robot.model] = &robot;
    for (std::uint32_t i = 0; i < frames_.size(); ++i) frames_[i] = link_frame(structure_, i);
    for (const Robot& robot : robots) frames_[robot.base] = robot.base_frame;
  }

  FrameTree build() {
    tree_.moved_by.assign(structure_.links.size(), -1);
    std::map<std::uint32_t, std::int32_t> carrier;  // cluster's frame link -> index in moving
    for (std::uint32_t i = 0; i < structure_.links.size(); ++i) add_link(i, carrier);
    add_odometry();
    add_sensors();
    return std::move(tree_);
  }

 private:
  const Robot* robot(std::uint32_t link) const {
    const auto found = robot_of_.find(structure_.links[link].model);
    return found == robot_of_.end() ? nullptr : found->second;
  }

  // The link whose frame stands for the whole cluster: a robot's base, else the first.
  std::uint32_t head(std::uint32_t link) {
    const std::uint32_t first = clusters_.first(link);
    const Robot* owner = robot(link);
    return owner != nullptr && clusters_.first(owner->base) == first ? owner->base : first;
  }

  const Pose& in_model(std::uint32_t link) const {
    const sim::LinkEntry& entry = structure_.links[link];
    return structure_.models[entry.model]->links[entry.link].pose;
  }

  void add_link(std::uint32_t link, std::map<std::uint32_t, std::int32_t>& carrier) {
    used_.insert(frames_[link]);
    if (clusters_.in_world(link)) {
      tree_.fixed.push_back({kWorld, frames_[link], snapshot_.link_poses[link]});
      return;
    }
    const std::uint32_t top = head(link);
    const Robot* owner = robot(link);
    const bool is_base = owner != nullptr && owner->base == top;
    if (!is_base && carrier.count(top) == 0) {
      MovingFrame moving{kWorld, frames_[top], top, {}};
      if (owner != nullptr) {
        moving.parent = owner->base_frame;
        moving.parent_link = owner->base;
      }
      carrier[top] = static_cast<std::int32_t>(tree_.moving.size());
      tree_.moving.push_back(std::move(moving));
    }
    if (!is_base) tree_.moved_by[link] = carrier[top];
    if (link == top) return;
    tree_.fixed.push_back({frames_[top], frames_[link], in_model(top).inverse() * in_model(link)});
  }

  // Odometry starts at 0 where its robot was put; a true one says where in the world it is.
  void add_odometry() {
    if (!odometry_in_world_) return;
    std::set<std::string> added;
    for (const sim::SensorEntry& sensor : structure_.sensors) {
      if (!is_odometry(sensor.kind)) continue;
      const std::vector<const Element*> plugin = {&sensor.desc->plugin_element};
      const std::string frame = value_of(plugin, "odometryFrame", "odom");
      const bool by_wheels = value_of(plugin, "odometrySource", "world") == "encoder";
      if (!added.insert(frame).second) continue;
      tree_.fixed.push_back(
          {kWorld, frame, by_wheels ? structure_.models[sensor.model]->pose : Pose{}});
    }
    for (const auto& [model, owner] : robot_of_) {
      tree_.fixed.push_back(
          {kWorld, owner->odom_frame, structure_.models[model]->pose * in_model(owner->base)});
    }
  }

  void add_sensors() {
    for (const sim::SensorEntry& sensor : structure_.sensors) {
      if (const auto foreign = foreign_frame(sensor, *structure_.models[sensor.model])) {
        tree_.sensors.push_back(*foreign);
        continue;
      }
      std::string frame = sensor.frame;
      if (frame.empty()) frame = sensor.name + (is_camera(sensor) ? "_optical_frame" : "");
      const Robot* owner = robot(sensor.link);
      if (owner != nullptr && !owner->first && !sensor.frame.empty()) {
        frame = owner->name + "/" + frame;
      }
      if (frame == frames_[sensor.link]) {  // an SDF that names its link's frame means it
        tree_.sensors.push_back(frame);
        continue;
      }
      if (!used_.insert(frame).second) {
        frame = sensor.kind + "_" + sensor.name;
        used_.insert(frame);
      }
      const Pose in_sensor = is_camera(sensor) ? Pose{Vec3::Zero(), kOptical} : Pose{};
      tree_.fixed.push_back({frames_[sensor.link], frame, sensor.pose * in_sensor});
      tree_.sensors.push_back(frame);
    }
  }

  const sim::Snapshot& snapshot_;
  const sim::Structure& structure_;
  bool odometry_in_world_;
  Clusters clusters_;
  std::map<std::uint32_t, const Robot*> robot_of_;
  std::vector<std::string> frames_;
  std::set<std::string> used_;
  FrameTree tree_;
};

}  // namespace

std::vector<std::string> robot_topics(const Robot& robot, const std::string& requested) {
  if (!requested.empty() && requested[0] == '/') return {graph_name(requested)};
  std::vector<std::string> topics = {graph_name("/" + robot.name + "/" + requested)};
  if (robot.first) topics.push_back(graph_name("/" + requested));
  return topics;
}

const Robot* robot_in(const std::vector<Robot>& robots, std::uint32_t model) {
  for (const Robot& robot : robots) {
    if (robot.model == model) return &robot;
  }
  return nullptr;
}

std::vector<Robot> find_robots(const sim::Structure& structure,
                               const std::vector<desc::Plugin>& world_plugins) {
  std::vector<Robot> robots;
  for (std::uint32_t d = 0; d < structure.devices.size(); ++d) {
    const sim::DeviceEntry& device = structure.devices[d];
    if (device.kind != "drive") continue;
    std::vector<const Element*> elements;
    for (const std::vector<desc::Plugin>* plugins :
         {&structure.models[device.model]->plugins, &world_plugins}) {
      for (const desc::Plugin& plugin : *plugins) {
        if (plugin.filename == "librobot_controller.so") elements.push_back(&plugin.element);
      }
    }
    Robot robot;
    robot.device = d;
    robot.model = device.model;
    robot.name = device.name;
    const std::string prefix = robots.empty() ? "" : robot.name + "/";
    const std::string base = value_of(elements, "robotBaseFrame", "base_footprint");
    robot.odom_frame = prefix + value_of(elements, "odometryFrame", "odom");
    robot.base_frame = prefix + base;
    robot.first = robots.empty();
    robot.command_topics = robot_topics(robot, value_of(elements, "commandTopic", "cmd_vel"));
    robot.odometry_topics = robot_topics(robot, value_of(elements, "odometryTopic", "odom"));
    bool found = false;
    for (std::uint32_t l = 0; l < structure.links.size(); ++l) {
      const sim::LinkEntry& link = structure.links[l];
      if (link.model != device.model) continue;
      const bool named = structure.models[link.model]->links[link.link].name == base;
      if (!found || named) robot.base = l;
      found = true;
      if (named) break;
    }
    if (found) robots.push_back(std::move(robot));
  }
  return robots;
}

FrameTree make_frames(const sim::Snapshot& snapshot, const std::vector<Robot>& robots,
                      bool odometry_in_world) {
  return Builder(snapshot, robots, odometry_in_world).build();
}

}  // namespace angen::node

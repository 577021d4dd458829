#include "gazebo/states.h"

#include <gazebo_msgs/LinkState.h>
#include <gazebo_msgs/ModelState.h>
#include <gazebo_msgs/PerformanceMetrics.h>
#include <ros/console.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/text.h"
#include "gazebo/services.h"
#include "ros/convert.h"

namespace angen::node::gazebo {

namespace {

constexpr std::chrono::seconds kMetricsPeriod(1);
constexpr std::chrono::milliseconds kStandingPeriod(100);  // while time does not advance
constexpr std::uint32_t kStatesQueue = 10;

// A model moves with its first link.
sim::Motion model_motion(const sim::Structure& structure, const sim::LinkEntry& first,
                         sim::Motion motion) {
  const desc::Model& model = *structure.models[first.model];
  const Vec3 link = motion.pose.position;
  motion.pose = motion.pose * model.links.front().pose.inverse();
  motion.linear += motion.angular.cross(motion.pose.position - link);
  return motion;
}

template <class Message>
void set_state(const sim::Motion& motion, std::size_t at, Message& message) {
  message.pose[at] = to_ros(motion.pose);
  message.twist[at] = twist_of(motion);
}

template <class Message>
void resize(std::size_t size, Message& message) {
  message.name.resize(size);
  message.pose.resize(size);
  message.twist.resize(size);
}

// Due times are known in closed form: samples that were leapt over count too.
double published(const sim::SensorEntry& sensor, const sim::Simulation& simulation,
                 Nanoseconds from, Nanoseconds to) {
  if (sensor.on_demand() && !simulation.requested(sensor.kind, sensor.name)) return 0.0;
  return static_cast<double>(sensor.schedule.publications(to) - sensor.schedule.publications(from));
}

bool makes_images(const Kind& kind) {
  return std::any_of(kind.fields.begin(), kind.fields.end(),
                     [](const Field& field) { return field.type == Field::Type::kImage; });
}

}  // namespace

geometry_msgs::Twist twist_of(const sim::Motion& motion) {
  geometry_msgs::Twist twist;
  twist.linear = to_vector(motion.linear);
  twist.angular = to_vector(motion.angular);
  return twist;
}

StateTopics::StateTopics(ros::NodeHandle node, Inbox& inbox, double rate)
    : inbox_(inbox),
      models_(
          LazyPublisher::of<gazebo_msgs::ModelStates>(node, "gazebo/model_states", kStatesQueue)),
      links_(LazyPublisher::of<gazebo_msgs::LinkStates>(node, "gazebo/link_states", kStatesQueue)),
      period_(std::max<Nanoseconds>(1, from_seconds(1.0 / rate))) {
  const boost::function<void(const gazebo_msgs::ModelState::ConstPtr&)> model =
      [this](const gazebo_msgs::ModelState::ConstPtr& state) { receive(*state); };
  set_model_ =
      node.subscribe<gazebo_msgs::ModelState>("gazebo/set_model_state", kStatesQueue, model);
  const boost::function<void(const gazebo_msgs::LinkState::ConstPtr&)> link =
      [this](const gazebo_msgs::LinkState::ConstPtr& state) { receive(*state); };
  set_link_ = node.subscribe<gazebo_msgs::LinkState>("gazebo/set_link_state", kStatesQueue, link);
}

template <class Message>
void StateTopics::receive(const Message& message) {
  try {
    inbox_.post(edit_of(*inbox_.simulation().snapshot()->structure, message));
  } catch (const Error& error) {
    ROS_WARN("a published state is rejected: %s", printable(error.what(), 2000).c_str());
  }
}

// Models before the first that came or went keep their numbers.
void StateTopics::follow(const sim::Snapshot& snapshot) {
  const std::shared_ptr<const sim::Structure> before =
      std::exchange(structure_, snapshot.structure);
  const auto& models = structure_->models;
  std::size_t kept = 0;
  if (before != nullptr) {
    const auto end =
        std::mismatch(models.begin(), models.end(), before->models.begin(), before->models.end());
    kept = static_cast<std::size_t>(end.first - models.begin());
  }
  resize(structure_->links.size(), link_states_);
  resize(models.size(), model_states_);
  for (std::size_t i = kept; i < models.size(); ++i) model_states_.name[i] = models[i]->name;
  for (std::uint32_t i = 0; i < structure_->links.size(); ++i) {
    const bool is_new = structure_->links[i].model >= kept;
    if (is_new) link_states_.name[i] = structure_->links[i].name;
    update(snapshot, i, is_new);
  }
}

void StateTopics::fill(std::uint32_t link) {
  const sim::LinkEntry& entry = structure_->links[link];
  const sim::Motion motion = inbox_.simulation().motion(link);
  set_state(motion, link, link_states_);
  if (entry.link != 0) return;
  set_state(model_motion(*structure_, entry, motion), entry.model, model_states_);
}

void StateTopics::update(const sim::Snapshot& snapshot, std::uint32_t link, bool is_new) {
  const bool is_fixed = !structure_->links[link].moves &&
                        link_states_.pose[link] == to_ros(snapshot.link_poses[link]);
  if (is_new || !is_fixed) fill(link);
}

void StateTopics::update(const sim::Snapshot& snapshot) {
  if (snapshot.structure != structure_) {
    follow(snapshot);
    return;
  }
  for (std::uint32_t i = 0; i < structure_->links.size(); ++i) update(snapshot, i, false);
}

void StateTopics::publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now) {
  if (!models_.has_subscribers() && !links_.has_subscribers()) return;
  const Nanoseconds slot = snapshot.time / period_;
  const bool is_due = snapshot.time == sent_time_ && now - sent_ >= kStandingPeriod;
  if (slot == slot_ && !is_due) return;
  slot_ = slot;
  sent_ = now;
  sent_time_ = snapshot.time;
  update(snapshot);
  models_.publish([&]() -> const auto& { return model_states_; });
  links_.publish([&]() -> const auto& { return link_states_; });
}

Performance::Performance(ros::NodeHandle node, const sim::Simulation& simulation)
    : simulation_(simulation),
      publisher_(LazyPublisher::of<gazebo_msgs::PerformanceMetrics>(
          node, "gazebo/performance_metrics", 10)) {}

void Performance::publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now) {
  if (now - sent_ < kMetricsPeriod) return;
  const double wall = std::chrono::duration<double>(now - sent_).count();
  const Nanoseconds from = std::min(sent_time_, snapshot.time);  // after a reset
  const double simulated = to_seconds(snapshot.time - from);
  sent_ = now;
  sent_time_ = snapshot.time;
  publisher_.publish([&] {
    gazebo_msgs::PerformanceMetrics message;
    message.header.stamp = to_ros(snapshot.time);
    message.real_time_factor = simulated / wall;
    for (const sim::SensorEntry& sensor : snapshot.structure->sensors) {
      gazebo_msgs::SensorPerformanceMetric metric;
      const double count = published(sensor, simulation_, from, snapshot.time);
      metric.name = snapshot.structure->links[sensor.link].name + "::" + sensor.name;
      metric.sim_update_rate = simulated > 0.0 ? count / simulated : 0.0;
      metric.real_update_rate = count / wall;
      metric.fps = makes_images(sensor.plugin->kind()) ? metric.real_update_rate : -1.0;
      message.sensors.push_back(std::move(metric));
    }
    return message;
  });
}

}  // namespace angen::node::gazebo

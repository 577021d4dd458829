#include "gazebo/performance.h"

#include <gazebo_msgs/PerformanceMetrics.h>

#include <algorithm>
#include <chrono>

#include "ros/convert.h"

namespace angen::node::gazebo {

namespace {

constexpr std::chrono::seconds kMetricsPeriod(1);

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

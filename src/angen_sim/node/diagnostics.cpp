#include "node/diagnostics.h"

#include <algorithm>
#include <chrono>

#include "core/text.h"
#include "ros/convert.h"

namespace angen::node {
namespace {

constexpr std::chrono::seconds kPeriod(1);
constexpr double kLow = 0.5;              // share of the requested rate
constexpr std::size_t kMaxFaulty = 1000;  // sensors

using Status = diagnostic_msgs::DiagnosticStatus;

void add(Status& status, const std::string& key, const std::string& value) {
  status.values.emplace_back();
  status.values.back().key = key;
  status.values.back().value = value;
}

Status status_of(const std::string& part, bool warns, const std::string& message) {
  Status status;
  status.name = "angen: " + part;
  status.hardware_id = "angen";
  status.level = warns ? Status::WARN : Status::OK;
  status.message = message;
  return status;
}

}  // namespace

Diagnostics::Diagnostics(ros::NodeHandle& node)
    : publisher_(LazyPublisher::of<diagnostic_msgs::DiagnosticArray>(node, "diagnostics", 10)) {}

void Diagnostics::publish(const sim::Snapshot& snapshot, double rate,
                          Pacer::Clock::time_point now) {
  note_faults(snapshot);
  if (now - sent_ < kPeriod) return;
  const double wall = std::chrono::duration<double>(now - sent_).count();
  const double factor = std::max(0.0, to_seconds(snapshot.time - sent_time_) / wall);
  publisher_.publish([&] {
    diagnostic_msgs::DiagnosticArray message;
    message.header.stamp = to_ros(snapshot.time);
    message.status = {time_status(snapshot, rate, factor), physics_status(snapshot),
                      sensor_status(snapshot)};
    return message;
  });
  sent_ = now;
  sent_time_ = snapshot.time;
  failed_steps_ = snapshot.counts.failed_steps;
}

void Diagnostics::note_faults(const sim::Snapshot& snapshot) {
  for (const sim::Event& event : snapshot.events) {
    if (event.kind != "fault") continue;
    if (faults_.size() == kMaxFaulty && faults_.count(event.source) == 0) continue;
    faults_[event.source] = event.event + ", " + event.detail;
  }
}

Status Diagnostics::time_status(const sim::Snapshot& snapshot, double rate, double factor) const {
  const bool late = !snapshot.paused && rate > 0.0 && factor < kLow * rate;
  Status status = status_of("time", late,
                            late              ? "slower than half of the requested rate"
                            : snapshot.paused ? "paused"
                                              : "runs");
  add(status, "real-time factor", number_text(factor));
  add(status, "requested rate", rate > 0.0 ? number_text(rate) : "as fast as possible");
  add(status, "simulated time (s)", number_text(to_seconds(snapshot.time)));
  return status;
}

Status Diagnostics::physics_status(const sim::Snapshot& snapshot) const {
  const std::uint64_t failed = snapshot.counts.failed_steps - failed_steps_;
  Status status = status_of("physics", failed > 0,
                            failed > 0 ? "steps were redone by the iterative solver" : "exact");
  add(status, "redone steps", std::to_string(snapshot.counts.failed_steps));
  add(status, "awake bodies", std::to_string(snapshot.counts.awake_bodies));
  return status;
}

Status Diagnostics::sensor_status(const sim::Snapshot& snapshot) const {
  const auto& sensors = snapshot.structure->sensors;
  Status status = status_of("sensors", false, "no faults");
  add(status, "sensors", std::to_string(sensors.size()));
  std::size_t faulty = 0;
  for (const sim::SensorEntry& sensor : sensors) {
    const auto fault = faults_.find(sensor.name);
    if (fault == faults_.end()) continue;
    ++faulty;
    add(status, sensor.name, fault->second);
  }
  if (faulty == 0) return status;
  status.level = Status::WARN;
  status.message =
      std::to_string(faulty) + (faulty == 1 ? " sensor has" : " sensors have") + " had faults";
  return status;
}

}  // namespace angen::node

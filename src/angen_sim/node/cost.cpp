#include "node/cost.h"

#include <time.h>

#include <algorithm>
#include <chrono>

#include "node/wall_second.h"
#include "ros/convert.h"

namespace angen::node {
namespace {

Nanoseconds process_time() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return now.tv_sec * kSecond + now.tv_nsec;
}

}  // namespace

angen_msgs::Cost to_message(const Spent& spent) {
  const sim::Cost& ticks = spent.ticks;
  const double simulated = to_seconds(ticks.simulated);
  const auto rate = [&](Nanoseconds cost) {
    return simulated > 0.0 ? to_seconds(cost) * 1e6 / simulated : 0.0;
  };
  angen_msgs::Cost message;
  message.simulated = simulated;
  message.elapsed = to_seconds(spent.elapsed);
  message.process = rate(spent.process);
  message.physics = rate(ticks.physics);
  message.devices = rate(ticks.devices);
  message.sensors = rate(ticks.sensors);
  message.commands = rate(ticks.commands);
  message.snapshots = rate(ticks.snapshots);
  message.publishing = rate(spent.publishing);
  message.network = rate(std::max<Nanoseconds>(spent.process - spent.main, 0));
  const auto add = [&](const auto& entry, Nanoseconds cost) {
    angen_msgs::InstanceCost instance;
    instance.kind = entry.kind;
    instance.name = entry.name;
    instance.cost = rate(cost);
    message.instances.push_back(std::move(instance));
  };
  const sim::Structure& structure = *ticks.structure;
  for (std::size_t i = 0; i < structure.devices.size(); ++i) {
    add(structure.devices[i], ticks.each_device[i]);
  }
  for (std::size_t i = 0; i < structure.sensors.size(); ++i) {
    add(structure.sensors[i], ticks.each_sensor[i]);
  }
  return message;
}

CostTopic::CostTopic(ros::NodeHandle& node, sim::Simulation& simulation)
    : simulation_(simulation),
      publisher_(LazyPublisher::of<angen_msgs::Cost>(node, "angen/cost", 10)) {}

void CostPeriod::restart(Nanoseconds time, Time now) {
  since_ = time;
  since_now_ = now;
}

bool CostPeriod::settled(Nanoseconds time, Time now) const {
  return time - first_ >= kSecond && now - first_now_ >= kWallSecond;
}

CostPeriod::Due CostPeriod::check(Nanoseconds time, bool paused, Time now) {
  const bool back = time < last_;  // a reset
  const bool still = paused && time == last_;
  if (last_ < 0 || (back && !settled_)) {
    first_ = time;
    first_now_ = now;
  }
  last_ = time;
  if (back) return Due::kDiscard;
  if (!settled_ && settled(time, now)) {
    settled_ = true;
    return Due::kDiscard;
  }
  if (now - since_now_ < kWallSecond) return Due::kNo;
  if (settled_ && time - since_ >= kSecond) return Due::kYes;
  return still ? Due::kStill : Due::kNo;
}

void CostTopic::restart(const sim::Snapshot& snapshot, Pacer::Clock::time_point now) {
  period_.restart(snapshot.time, now);
  process_since_ = process_time();
  main_since_ = Stopwatch::system_clocks().cpu();
  publishing_ = 0;
}

void CostTopic::publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now) {
  publishing_ += watch_.lap();
  using Due = CostPeriod::Due;
  const Due due = period_.check(snapshot.time, snapshot.paused, now);
  if (publisher_.has_subscribers() != measuring_) {
    measuring_ = !measuring_;
    simulation_.measure(measuring_);
    simulation_.take_cost();
    restart(snapshot, now);
    return;
  }
  if (!measuring_ || due == Due::kNo) return;
  Spent spent{simulation_.take_cost(), publishing_, process_time() - process_since_,
              Stopwatch::system_clocks().cpu() - main_since_,
              std::chrono::nanoseconds(now - period_.since()).count()};
  restart(snapshot, now);
  if (due == Due::kDiscard) return;
  if (due == Due::kStill) spent.ticks.simulated = 0;
  publisher_.publish([&] {
    angen_msgs::Cost message = to_message(spent);
    message.header.stamp = to_ros(snapshot.time);
    return message;
  });
}

}  // namespace angen::node

#include "sim/sensor_scheduler.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace angen::sim {

namespace {

using Sensors = std::vector<std::uint32_t>;

/// Removes and returns those for which `matches` is true.
template <class F>
Sensors take(Sensors& from, F&& matches) {
  const auto removed = std::stable_partition(
      from.begin(), from.end(), [&](std::uint32_t sensor) { return !matches(sensor); });
  Sensors taken(removed, from.end());
  from.erase(removed, from.end());
  return taken;
}

/// Both ascend.
void merge(Sensors& into, const Sensors& more) {
  const auto middle = static_cast<std::ptrdiff_t>(into.size());
  into.insert(into.end(), more.begin(), more.end());
  std::inplace_merge(into.begin(), into.begin() + middle, into.end());
}

}  // namespace

void SensorScheduler::assign(const std::vector<Schedule>& schedules, Nanoseconds now) {
  groups_.clear();
  group_of_.clear();
  idle_.assign(schedules.size(), 0);
  // A group: sensors whose samples and publications fall on the same ticks from now on.
  std::map<std::tuple<Nanoseconds, Nanoseconds, Nanoseconds, Nanoseconds>, std::uint32_t> known;
  for (std::uint32_t i = 0; i < schedules.size(); ++i) {
    const Schedule& schedule = schedules[i];
    const auto count = static_cast<std::uint32_t>(groups_.size());
    const auto [at, is_new] =
        known.emplace(std::make_tuple(schedule.next(now), schedule.sample, schedule.publish,
                                      schedule.start % schedule.publish),
                      count);
    if (is_new) groups_.emplace_back().schedule = schedule;
    groups_[at->second].active.push_back(i);
    group_of_.push_back(at->second);
  }
  requeue(now);
}

void SensorScheduler::requeue(Nanoseconds now) {
  queue_ = {};
  for (std::uint32_t i = 0; i < groups_.size(); ++i)
    queue_.push({groups_[i].schedule.next(now), i});
}

const std::vector<std::uint32_t>& SensorScheduler::collect(Nanoseconds now) {
  due_.clear();
  while (!queue_.empty() && queue_.top().time <= now) {
    due_.push_back(queue_.top().group);
    queue_.pop();
    const Schedule& schedule = groups_[due_.back()].schedule;
    queue_.push({schedule.next(std::max(now, schedule.start + 1)), due_.back()});
  }
  return due_;
}

void SensorScheduler::make_idle(std::uint32_t sensor) { set(sensor, true); }
void SensorScheduler::activate(std::uint32_t sensor) { set(sensor, false); }

void SensorScheduler::set(std::uint32_t sensor, bool idle) {
  idle_[sensor] = idle ? 1 : 0;
  groups_[group_of_[sensor]].outdated = true;
}

void SensorScheduler::update_lists(Group& group) {
  if (!std::exchange(group.outdated, false)) return;
  const Sensors now_idle = take(group.active, [&](std::uint32_t i) { return is_idle(i); });
  const Sensors now_active = take(group.idle, [&](std::uint32_t i) { return !is_idle(i); });
  merge(group.idle, now_idle);
  merge(group.active, now_active);
}

}  // namespace angen::sim

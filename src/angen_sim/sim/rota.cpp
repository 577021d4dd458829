#include "sim/rota.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace angen::sim {

namespace {

using Sensors = std::vector<std::uint32_t>;

/// Takes those out that `wanted` says.
template <class F>
Sensors take(Sensors& from, F&& wanted) {
  const auto gone = std::stable_partition(from.begin(), from.end(),
                                          [&](std::uint32_t sensor) { return !wanted(sensor); });
  Sensors taken(gone, from.end());
  from.erase(gone, from.end());
  return taken;
}

/// Both ascend.
void merge(Sensors& into, const Sensors& more) {
  const auto middle = static_cast<std::ptrdiff_t>(into.size());
  into.insert(into.end(), more.begin(), more.end());
  std::inplace_merge(into.begin(), into.begin() + middle, into.end());
}

}  // namespace

void Rota::assign(const std::vector<Rhythm>& rhythms, Nanoseconds now) {
  groups_.clear();
  group_of_.clear();
  calm_.assign(rhythms.size(), 0);
  // Those whose looks and publications fall on the same ticks from now on.
  std::map<std::tuple<Nanoseconds, Nanoseconds, Nanoseconds, Nanoseconds>, std::uint32_t> known;
  for (std::uint32_t i = 0; i < rhythms.size(); ++i) {
    const Rhythm& rhythm = rhythms[i];
    const auto count = static_cast<std::uint32_t>(groups_.size());
    const auto [at, is_new] =
        known.emplace(std::make_tuple(rhythm.next(now), rhythm.sample, rhythm.publish,
                                      rhythm.start % rhythm.publish),
                      count);
    if (is_new) groups_.emplace_back().rhythm = rhythm;
    groups_[at->second].awake.push_back(i);
    group_of_.push_back(at->second);
  }
  requeue(now);
}

void Rota::requeue(Nanoseconds now) {
  queue_ = {};
  for (std::uint32_t i = 0; i < groups_.size(); ++i) queue_.push({groups_[i].rhythm.next(now), i});
}

const std::vector<std::uint32_t>& Rota::collect(Nanoseconds now) {
  due_.clear();
  while (!queue_.empty() && queue_.top().time <= now) {
    due_.push_back(queue_.top().group);
    queue_.pop();
    queue_.push({groups_[due_.back()].rhythm.next(now), due_.back()});
  }
  return due_;
}

void Rota::calm(std::uint32_t sensor) { set(sensor, true); }
void Rota::rouse(std::uint32_t sensor) { set(sensor, false); }

void Rota::set(std::uint32_t sensor, bool calm) {
  calm_[sensor] = calm ? 1 : 0;
  groups_[group_of_[sensor]].shifts = true;
}

void Rota::shift(Group& group) {
  if (!std::exchange(group.shifts, false)) return;
  const Sensors calmed = take(group.awake, [&](std::uint32_t i) { return is_calm(i); });
  const Sensors roused = take(group.calm, [&](std::uint32_t i) { return !is_calm(i); });
  merge(group.calm, calmed);
  merge(group.awake, roused);
}

}  // namespace angen::sim

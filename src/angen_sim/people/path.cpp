#include "people/path.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "plugin/plugin.h"

namespace angen::people {

namespace {

constexpr double kClosingSpeed = 1.0;  // m/s
constexpr double kNear = 1e-6;         // m: nearer waypoints are the same place

}  // namespace

Path::Path(std::vector<Waypoint> waypoints, bool loop)
    : waypoints_(std::move(waypoints)), loop_(loop) {
  if (!loop_ || waypoints_.size() < 2) {
    loop_ = false;
    return;
  }
  const Waypoint& first = waypoints_.front();
  const Waypoint& last = waypoints_.back();
  const double gap = std::hypot(first.x - last.x, first.y - last.y);
  if (gap < kNear) return;
  Waypoint back = first;
  back.time = last.time + from_seconds(gap / kClosingSpeed);
  waypoints_.push_back(back);
}

Path::Place Path::at(Nanoseconds time) const {
  const Nanoseconds begin = waypoints_.front().time;
  const Nanoseconds end = waypoints_.back().time;
  if (loop_ && time >= end) time = begin + (time - begin) % (end - begin);
  const auto after = std::upper_bound(waypoints_.begin(), waypoints_.end(), time,
                                      [](Nanoseconds t, const Waypoint& w) { return t < w.time; });
  if (after == waypoints_.begin() || after == waypoints_.end()) {
    const Waypoint& stays = after == waypoints_.end() ? waypoints_.back() : waypoints_.front();
    return {stays.x, stays.y, 0.0, 0.0, stays.yaw};
  }
  const Waypoint& from = *(after - 1);
  const Waypoint& to = *after;
  const double seconds = to_seconds(to.time - from.time);
  const double share = to_seconds(time - from.time) / seconds;
  const double dx = to.x - from.x;
  const double dy = to.y - from.y;
  Place place{from.x + share * dx, from.y + share * dy, dx / seconds, dy / seconds, 0.0};
  if (is_pause(from, to)) {
    place.vx = place.vy = 0.0;
    place.yaw = from.yaw + share * std::remainder(to.yaw - from.yaw, 2.0 * M_PI);
  } else {
    place.yaw = std::atan2(dy, dx);
  }
  return place;
}

Nanoseconds Path::still_until(Nanoseconds time) const {
  const Nanoseconds begin = waypoints_.front().time;
  const Nanoseconds length = waypoints_.back().time - begin;
  Nanoseconds lap = loop_ && time >= begin ? (time - begin) / length * length : 0;
  for (int round = 0; round < (loop_ ? 2 : 1); ++round, lap += length) {
    for (std::size_t i = 0; i + 1 < waypoints_.size(); ++i) {
      if (is_pause(waypoints_[i], waypoints_[i + 1]) || lap + waypoints_[i + 1].time <= time)
        continue;
      return std::max(time, lap + waypoints_[i].time);
    }
  }
  return kForever;
}

bool Path::is_pause(const Waypoint& from, const Waypoint& to) {
  return std::hypot(to.x - from.x, to.y - from.y) < kNear;
}

}  // namespace angen::people

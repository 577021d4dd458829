#include "people/navigator.h"

#include <algorithm>

#include "people/others.h"
#include "plugin/view.h"

namespace angen::people {

namespace {

constexpr double kNearGoal = 0.06;  // m: a place that fits instead of the goal
constexpr double kOpenToll = 3.0;   // m that a door which it can open counts
constexpr double kWaitToll = 30.0;  // m that another shut door counts
constexpr double kSeenCell = 0.02;  // m
constexpr int kPlacesTried = 8;     // to shut a leaf from
constexpr double kItsBody = 0.35;   // m about one who walks on, who is no obstacle for long

// Places behind a person that a passage may have, at most: 10 m.
constexpr std::size_t kPlacesBack = 200;

std::vector<Navigator::Vec2> straight(const Navigator::Vec2& from, const Navigator::Vec2& to) {
  const int steps = static_cast<int>((to - from).norm() / FloorMap::kCell) + 1;
  std::vector<Navigator::Vec2> places;
  for (int i = 0; i <= steps; ++i) {
    places.emplace_back(from + (to - from) * (static_cast<double>(i) / steps));
  }
  return places;
}

}  // namespace

void Navigator::forget() {
  route_.reset();
  target_.reset();
  seen_.clear();
  failed_.clear();
  passages_.clear();
}

bool Navigator::plan(const View& view, const Vec3& feet, const Vec2& to, bool with_seen) {
  const Vec2 at = feet.head<2>();
  const std::vector<DoorSeen> doors = doors_seen(view, feet.z());
  if (!with_seen && !door_on_way(doors, at, to)) {
    FloorMap strip(view, feet, to, FloorMap::Extent::kStraight);
    if (strip.is_clear(at, to) && strip.has_floor(view, at, to)) {
      route_.reset();
      passages_ = passages_of(strip, straight(at, to));
      if (is_in_passage(at)) add_passage_behind(*maps_->find(view, feet, to), straight(at, to));
      return Surroundings::has_room(view, {to.x(), to.y(), feet.z()});
    }
  }
  const std::shared_ptr<const FloorMap> storey = maps_->find(view, feet, to);
  FloorMap map = map_with(view, feet, to, with_seen ? seen_ : std::vector<Vec2>{});
  std::optional<std::vector<Vec2>> way = map.way(view, at, to, kNearGoal);
  if (!way && with_seen) return false;  // the former way is kept
  passages_.clear();
  route_.reset();
  if (!way) return Surroundings::is_walkable(view, feet, to);
  const bool is_known = storey->cells() > 0;
  if (!with_seen && is_known && !Surroundings::has_room(view, {to.x(), to.y(), feet.z()})) {
    return false;
  }
  passages_ = passages_of(*storey, *way);
  if (is_in_passage(at)) add_passage_behind(*storey, *way);
  route_.emplace(std::move(map), std::move(*way));
  return true;
}

FloorMap Navigator::map_with(const View& view, const Vec3& feet, const Vec2& to,
                             const std::vector<Vec2>& points) const {
  FloorMap map = *maps_->find(view, feet, to);
  map.add_points(points);
  for (const DoorSeen& door : doors_seen(view, feet.z())) {
    if (door.is_passable()) continue;
    map.add_toll(door.hinge, door.edge(), opens_doors_ ? kOpenToll : kWaitToll);
  }
  return map;
}

const Navigator::Vec2& Navigator::advance(const Vec2& at, const Vec2& to) {
  return target_.emplace(route_ ? route_->follow(at) : to);
}

std::vector<Navigator::Vec2> Navigator::ahead() const {
  std::vector<Vec2> places{*target_};
  if (!route_) return places;
  const std::vector<Vec2> next = route_->next();
  places.insert(places.end(), next.begin(), next.end());
  return places;
}

double Navigator::left(const Vec2& at, const Vec2& to) const {
  return route_ ? route_->left(at) : (to - at).norm();
}

void Navigator::learn(const View& view, const Vec3& feet, const Surroundings& seen) {
  Surroundings::remove_gone(view, feet, seen_);
  const std::vector<Other> others = others_near(view, feet);
  for (const Vec2& point : seen.points()) {
    const bool walks_on = std::any_of(others.begin(), others.end(), [&](const Other& other) {
      return other.on_way && (other.at() - point).norm() < kItsBody;
    });
    if (!walks_on) seen_.push_back(kSeenCell * (point / kSeenCell).array().round().matrix());
  }
  const auto before = [](const Vec2& a, const Vec2& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  };
  std::sort(seen_.begin(), seen_.end(), before);
  seen_.erase(std::unique(seen_.begin(), seen_.end()), seen_.end());
  // A shut door is no obstacle, and what was behind it may be gone; of an open leaf it knows all.
  for (const DoorSeen& door : doors_seen(view, feet.z())) {
    if (door.is_open() && (door.hinge - feet.head<2>()).norm() < Surroundings::kSight) {
      add_line(door.hinge, door.open, door.width);
    }
    if (std::count(failed_.begin(), failed_.end(), door.name) > 0) continue;
    const auto is_hidden = [&](const Vec2& at) { return door.hides(at, feet.head<2>()); };
    seen_.erase(std::remove_if(seen_.begin(), seen_.end(), is_hidden), seen_.end());
  }
}

std::string Navigator::why_not(const View& view, const Vec3& feet, const Vec2& to) const {
  if (!failed_.empty()) return why_failed_ + ", and it knows no other way";
  const Vec3 there(to.x(), to.y(), feet.z());
  const std::string own = view.model_of(view.own_shapes().at(0));
  const auto model_at = [&](const Vec3& from, const Vec3& end, double near) -> std::string {
    const double length = (end - from).norm();
    for (const rays::Crossing& c : view.rays().crossings(from, end)) {
      const std::string model = view.model_of(c.shape);
      if (model != own && length - c.leave < near) return model;
    }
    return "";
  };
  const Vec3 knee = 0.5 * kHead * Vec3::UnitZ();
  std::string model = model_at(feet + knee, there + knee, FloorMap::kClearance);
  if (model.empty())
    model = model_at(there + kHead * Vec3::UnitZ(), there + kLow * Vec3::UnitZ(), kHead);
  if (!model.empty()) return model + " is there";
  const FloorMap map(view, there, to, FloorMap::Extent::kStraight);
  if (!map.is_free(to)) return "there is no room for a person";
  if (!map.has_floor(view, to, to)) return "there is no floor";
  if (!Surroundings::has_room(view, there)) return "there is no room for a person";
  return "no way leads there";
}

std::optional<Navigator::LeafInWay> Navigator::leaf_in_way(const View& view, const Vec3& feet,
                                                           const Vec2& to) const {
  if (!opens_doors_) return std::nullopt;
  const Vec2 at = feet.head<2>();
  for (const DoorSeen& door : doors_seen(view, feet.z())) {
    if ((door.hinge - at).norm() > Surroundings::kSight) continue;
    const std::vector<Vec2> places = places_to_shut(view, feet, door);
    if (places.empty()) continue;
    Navigator shut = *this;
    shut.forget_leaf(door);
    if (!map_with(view, feet, to, shut.seen_).way(view, at, to, kNearGoal)) continue;
    FloorMap open = map_with(view, feet, to, seen_);
    int tries = 0;
    for (const Vec2& place : places) {
      if (place == at) return LeafInWay{door, place};
      if (!open.is_free(place) || ++tries > kPlacesTried) continue;
      if (open.way(view, at, place, kNearGoal)) return LeafInWay{door, place};
    }
  }
  return std::nullopt;
}

void Navigator::forget_leaf(const DoorSeen& door) {
  const auto is_on_leaf = [&](const Vec2& point) { return door.has_on_leaf(point); };
  seen_.erase(std::remove_if(seen_.begin(), seen_.end(), is_on_leaf), seen_.end());
}

std::string Navigator::what_blocks(const View& view, const Vec3& feet, const Vec2& to) const {
  FloorMap map = map_with(view, feet, to, {});
  const std::optional<std::vector<Vec2>> way = map.way(view, feet.head<2>(), to, kNearGoal);
  if (!way) return "";
  for (const Vec2& place : *way) {
    for (const Vec2& point : seen_) {
      if ((point - place).norm() >= FloorMap::kClearance) continue;
      const std::string model = Surroundings::model_at(view, feet, point);
      if (!model.empty()) return model;
    }
  }
  return "";
}

bool Navigator::is_in_passage(const Vec2& at) const {
  return !passages_.empty() && passages_.front().holds(at);
}

// The part behind it counts, too: it may have to walk back.
void Navigator::add_passage_behind(const FloorMap& map, std::vector<Vec2> way) {
  const Vec2 ahead = way[std::min<std::size_t>(4, way.size() - 1)] - way.front();
  std::vector<Vec2> back;
  for (Vec2 place = way.front(); ahead.norm() > 0.0 && back.size() < kPlacesBack;) {
    place -= FloorMap::kCell * ahead.normalized();
    if (!map.is_free(place)) break;
    back.push_back(place);
  }
  way.insert(way.begin(), back.rbegin(), back.rend());
  passages_ = passages_of(map, way);
}

void Navigator::add_line(const Vec2& from, const Vec2& along, double length) {
  for (double at = 0.0; at < length; at += kSeenCell) seen_.push_back(from + at * along);
}

void Navigator::note_failed(const DoorSeen& door, std::string why) {
  add_line(door.hinge, door.along, door.width);
  failed_.push_back(door.name);
  why_failed_ = std::move(why);
}

}  // namespace angen::people

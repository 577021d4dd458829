#include "people/surroundings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <queue>
#include <utility>

#include "people/floor_map.h"
#include "plugin/view.h"

namespace angen::people {

namespace {

using Vec2 = Surroundings::Vec2;

constexpr int kDirections = 48;
constexpr double kKneeHeight = 0.45;  // m, as the seats of chairs
constexpr double kChest = 1.2;        // m
constexpr double kHeights[] = {0.15, kKneeHeight, 0.738,
                               kChest};  // m; one is in the tops of tables
constexpr double kBeyond = 0.1;          // m
constexpr double kGraze = 1e-3;          // m
constexpr double kOwn = 0.255;           // m, up to the person's own surface
constexpr double kHolds = 4.2;           // m to what holds one who saw it and has stepped back

// m around: where it looks for the end of the floor, by turns; who runs needs the way to stop.
constexpr double kEdgesAt[] = {0.6, 1.3};
constexpr double kEdgeWide = 0.15;  // m: a gap that is narrower is stepped over
constexpr double kAbove = 0.2;      // m above its feet, where that look begins
constexpr double kDrop = 0.4;       // m: it steps down less than this
constexpr int kEdgeHalvings = 6;    // an edge is found to 1 or 2 cm

constexpr rays::Mobilities kFixed = rays::only(rays::Mobility::kStatic);
constexpr double kRoomSight = 0.6;     // m around a goal, where it looks for room
constexpr int kRoomDirections = 32;    // it looks in so many
constexpr double kRoomAway = 0.13;     // m: a place that is nearer to a goal is as good
constexpr int kRoomRings = 6;          // circles of such places
constexpr double kNextSurface = 1e-6;  // m
constexpr double kFloorAhead = 0.05;   // m, in which the floor of a straight way is looked at
constexpr float kSlope = 0.94F;        // cosine of 20 degrees: a less steep surface is walked up
constexpr double kSlopeStep = 0.1;     // m, in which a slope is looked at …
constexpr double kRise = 0.05;         // m … and rises or falls at most
constexpr double kStepsAhead[] = {0.35, 0.15, 0.0};  // m, of a step aside
constexpr double kStepAside = 0.6;                   // m, at most

// The way round is looked for on a grid around the person.
constexpr double kCell = 0.1;  // m
constexpr int kHalf = 30;      // cells from the middle to the edge
constexpr int kSide = 2 * kHalf + 1;
constexpr std::size_t kCells = std::size_t{kSide} * kSide;
constexpr double kWide = 0.33;       // m
constexpr double kRoomy = 0.5;       // m: nearer to something costs more
constexpr double kTight = 3.0;       // cost a meter, per meter nearer than kRoomy
constexpr double kLeft = 0.3;        // cost a meter, per meter to the left of the straight way
constexpr double kStuck = 0.15;      // m around the person that it may leave in any case
constexpr double kNearer = 0.3;      // m, at least, that a way must lead nearer
constexpr double kLongestWay = 3.0;  // times the straight way …
constexpr double kExtra = 2.0;       // … and these meters more

bool is_obstacle(const rays::Hit& hit) { return hit.hit() && hit.normal.z() < kSlope; }

rays::Ray down_at(const Vec3& feet, const Vec2& place) {
  return {Vec3(place.x(), place.y(), feet.z() + kAbove), -Vec3::UnitZ(), 0.0, kAbove + kDrop};
}

Vec2 unit(int i, int count) {
  const double angle = 2.0 * M_PI * i / count;
  return {std::cos(angle), std::sin(angle)};
}

/// The floor under a place, from a step above `z` to a drop below it, that is none of some models.
std::optional<double> floor_below(const View& view, const Vec2& place, double z,
                                  const std::vector<std::string>& but) {
  rays::Ray down = down_at({place.x(), place.y(), z}, place);
  std::vector<rays::Hit> hits;
  for (std::size_t surface = 0; surface <= 2 * but.size(); ++surface) {
    view.rays().cast({down}, hits);
    if (!hits[0].hit()) return std::nullopt;
    const bool is_floor =
        but.empty() || std::count(but.begin(), but.end(), view.model_of(hits[0].shape)) == 0;
    if (is_floor) return down.origin.z() - hits[0].range;
    down.min = hits[0].range + kNextSurface;
  }
  return std::nullopt;
}

/// The model that a person at `feet` stands on; empty if it falls.
std::string model_below(const View& view, const Vec3& feet) {
  const std::vector<std::uint32_t> own = view.own_shapes();
  rays::Ray down = down_at(feet, feet.head<2>());
  std::vector<rays::Hit> hits;
  for (std::size_t surface = 0; surface <= 2 * own.size(); ++surface) {
    view.rays().cast({down}, hits);
    if (!hits[0].hit()) break;
    if (std::count(own.begin(), own.end(), hits[0].shape) == 0) {
      return view.model_of(hits[0].shape);
    }
    down.min = hits[0].range + kNextSurface;
  }
  return "";
}

/// m along a unit direction to the end of the floor; none if that is not before `reach`.
template <typename HasFloor>
std::optional<double> edge_before(double reach, const HasFloor& has_floor) {
  if (has_floor(reach) || has_floor(reach + kEdgeWide)) return std::nullopt;
  double floor = 0.0;
  double edge = reach;
  for (int half = 0; half < kEdgeHalvings; ++half) {
    const double middle = 0.5 * (floor + edge);
    (has_floor(middle) ? floor : edge) = middle;
  }
  return edge;
}

class Grid {
 public:
  Grid(const Vec2& middle, const std::vector<Vec2>& points) : middle_(middle) {
    gap_.fill(std::numeric_limits<double>::infinity());
    for (const Vec2& point : points) add(point);
    for (double& gap : gap_) gap = std::min(kRoomy, kCell * std::sqrt(gap));
  }

  Vec2 place(int cell) const {
    return middle_ + kCell * Vec2(cell % kSide - kHalf, cell / kSide - kHalf);
  }

  // Dijkstra's shortest ways of a body from the middle to all cells, by cost.
  void spread(const Vec2& left, double body) {
    cost_.fill(std::numeric_limits<double>::infinity());
    from_.fill(-1);
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const double lengths[] = {0.0, kCell, kCell * std::hypot(1.0, 1.0)};  // m, of a step
    cost_[kMiddle] = 0.0;
    open.push({0.0, kMiddle});
    while (!open.empty()) {
      const auto [cost, cell] = open.top();
      open.pop();
      if (cost > cost_[cell]) continue;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int x = cell % kSide + dx;
          const int y = cell / kSide + dy;
          if (x < 0 || y < 0 || x >= kSide || y >= kSide) continue;
          const int next = y * kSide + x;
          const double length = lengths[std::abs(dx) + std::abs(dy)];
          if (cost + length >= cost_[next]) continue;  // no rate is below 1
          if (!passable(next, body)) continue;
          const double aside = std::max(0.0, left.dot(place(next) - middle_));
          const double rate = 1.0 + kTight * (kRoomy - gap_[next]) + kLeft * aside;
          const double reached = cost + length * rate;
          if (reached >= cost_[next]) continue;
          cost_[next] = reached;
          from_[next] = cell;
          open.push({reached, next});
        }
      }
    }
  }

  // The reached cell from which it is the shortest to `to`.
  int best(const Vec2& to) const {
    int best = kMiddle;
    double least = std::numeric_limits<double>::infinity();
    for (int cell = 0; cell < kSide * kSide; ++cell) {
      if (!std::isfinite(cost_[cell])) continue;
      const double rest = (to - place(cell)).norm() + 1e-3 * cost_[cell];
      if (rest >= least) continue;
      least = rest;
      best = cell;
    }
    return best;
  }

  std::vector<int> way_to(int cell) const {
    std::vector<int> way;
    for (; cell >= 0; cell = from_[cell]) way.push_back(cell);
    std::reverse(way.begin(), way.end());
    return way;
  }

 private:
  static constexpr int kMiddle = kHalf * kSide + kHalf;

  void add(const Vec2& point) {
    const Vec2 at = (point - middle_) / kCell;
    const int reach = static_cast<int>(kRoomy / kCell) + 1;
    const int column = static_cast<int>(std::lround(at.x()));
    const int row = static_cast<int>(std::lround(at.y()));
    for (int y = std::max(row - reach, -kHalf); y <= std::min(row + reach, kHalf); ++y) {
      for (int x = std::max(column - reach, -kHalf); x <= std::min(column + reach, kHalf); ++x) {
        double& square = gap_[(y + kHalf) * kSide + x + kHalf];
        square = std::min(square, (Vec2(x, y) - at).squaredNorm());
      }
    }
  }

  bool passable(int cell, double body) const {
    return gap_[cell] >= body || (place(cell) - middle_).norm() < kStuck;
  }

  Vec2 middle_;
  std::array<double, kCells> gap_;   // m to the next point, at most kRoomy
  std::array<double, kCells> cost_;  // cost of the way from the middle
  std::array<int, kCells> from_;
};

}  // namespace

// Each scan's directions lie between those of the one before.
void Surroundings::scan(const View& view, const Vec3& feet) {
  points_.resize(fresh_);
  rays_.clear();
  turned_ = !turned_;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * M_PI * (i + (turned_ ? 0.5 : 0.0)) / kDirections;
    const Vec3 direction(std::cos(angle), std::sin(angle), 0.0);
    for (const double height : kHeights) {
      rays_.push_back({feet + height * Vec3::UnitZ(), direction, kOwn, kSight});
    }
  }
  view.rays().cast(rays_, hits_);
  std::vector<Vec2> seen;
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    if (!is_obstacle(hits_[i])) continue;
    seen.emplace_back((rays_[i].origin + hits_[i].range * rays_[i].direction).head<2>());
  }
  find_edges(view, feet, seen);
  fresh_ = seen.size();
  points_.insert(points_.begin(), seen.begin(), seen.end());
}

// The ends of the floor that it sees, as points that it does not walk over.
void Surroundings::find_edges(const View& view, const Vec3& feet, std::vector<Vec2>& seen) const {
  const auto has_floor = [&](const Vec2& place) {
    std::vector<rays::Hit> hits;
    view.rays().cast({down_at(feet, place)}, hits);
    return hits[0].hit();
  };
  const double reach = kEdgesAt[turned_ ? 0 : 1];
  std::vector<Vec2> directions;
  std::vector<rays::Ray> down;
  for (std::size_t i = 0; i < rays_.size(); i += std::size(kHeights)) {
    const auto first = hits_.begin() + static_cast<std::ptrdiff_t>(i);
    const bool hidden = std::any_of(first, first + std::size(kHeights), [&](const rays::Hit& hit) {
      return hit.hit() && hit.range < reach + kEdgeWide;
    });
    if (hidden) continue;
    directions.emplace_back(rays_[i].direction.head<2>());
    down.push_back(down_at(feet, feet.head<2>() + reach * directions.back()));
  }
  std::vector<rays::Hit> hits;
  view.rays().cast(down, hits);
  for (std::size_t i = 0; i < down.size(); ++i) {
    const Vec2 at = feet.head<2>();
    if (hits[i].hit() || has_floor(at + (reach + kEdgeWide) * directions[i])) continue;
    if (!has_floor(at)) return;  // it falls
    double floor = 0.0;
    double edge = reach;
    for (int half = 0; half < kEdgeHalvings; ++half) {
      const double middle = 0.5 * (floor + edge);
      (has_floor(at + middle * directions[i]) ? floor : edge) = middle;
    }
    seen.emplace_back(at + edge * directions[i]);
  }
}

void Surroundings::scan_floor(const View& view, const Vec3& feet) {
  points_.clear();
  const Vec2 at = feet.head<2>();
  if (!floor_below(view, at, feet.z(), {})) return;  // it falls
  const std::string below = model_below(view, feet);
  for (int i = 0; i < kDirections; ++i) {
    const Vec2 along = unit(i, kDirections);
    rays_.clear();
    for (const double height : kHeights) {
      rays_.push_back({feet + height * Vec3::UnitZ(), {along.x(), along.y(), 0.0}, kOwn, kSight});
    }
    for (const double reach : kEdgesAt) {
      const double sight = reach + kEdgeWide;
      view.rays().cast(rays_, hits_, kFixed);
      const auto is_near = [&](const rays::Hit& hit) { return hit.hit() && hit.range < sight; };
      if (std::any_of(hits_.begin(), hits_.end(), is_near)) continue;
      view.rays().cast(rays_, hits_);
      std::vector<std::string> ahead;  // what it may push away from over the floor
      for (const rays::Hit& hit : hits_) {
        if (is_near(hit)) ahead.push_back(view.model_of(hit.shape));
      }
      ahead.erase(std::remove(ahead.begin(), ahead.end(), below), ahead.end());
      const auto edge = edge_before(reach, [&](double away) {
        return floor_below(view, at + away * along, feet.z(), ahead).has_value();
      });
      if (edge) points_.emplace_back(at + *edge * along);
    }
  }
  fresh_ = points_.size();
}

bool Surroundings::has_floor(const View& view, const Vec3& feet, const Vec2& to) {
  const Vec2 at = feet.head<2>();
  const int steps = static_cast<int>(std::ceil((to - at).norm() / kFloorAhead));
  double z = feet.z();
  int missing = 0;
  for (int i = 1; i <= steps; ++i) {
    const std::optional<double> floor =
        floor_below(view, at + (to - at) * (static_cast<double>(i) / steps), z, {});
    missing = floor ? 0 : missing + 1;
    z = floor.value_or(z);
    if (missing * kFloorAhead > kEdgeWide) return false;
  }
  return missing == 0;
}

bool Surroundings::has_room(const View& view, const Vec3& place) {
  const Vec2 at = place.head<2>();
  std::vector<Vec2> points;
  std::vector<rays::Hit> hits;
  for (int i = 0; i < kRoomDirections; ++i) {
    const Vec2 along = unit(i, kRoomDirections);
    std::vector<rays::Ray> around;
    for (const double height : kHeights) {
      around.push_back(
          {place + height * Vec3::UnitZ(), {along.x(), along.y(), 0.0}, 0.0, kRoomSight});
    }
    view.rays().cast(around, hits);
    const bool is_hidden =
        std::any_of(hits.begin(), hits.end(), [](const rays::Hit& hit) { return hit.hit(); });
    view.rays().cast(around, hits, kFixed);
    for (const rays::Hit& hit : hits) {
      if (is_obstacle(hit)) points.emplace_back(at + hit.range * along);
    }
    if (is_hidden) continue;
    const auto edge = edge_before(kRoomSight - kEdgeWide, [&](double away) {
      return floor_below(view, at + away * along, place.z(), {}).has_value();
    });
    if (edge) points.emplace_back(at + *edge * along);
  }
  for (int ring = 0; ring <= kRoomRings; ++ring) {
    for (int i = 0; i < kRoomDirections; ++i) {
      const Vec2 there = at + kRoomAway * ring / kRoomRings * unit(i, kRoomDirections);
      const bool is_free = std::none_of(points.begin(), points.end(), [&](const Vec2& point) {
        return (point - there).norm() < FloorMap::kClearance;
      });
      if (is_free) return true;
    }
  }
  return false;
}

std::string Surroundings::model_ahead(const View& view, const Vec3& feet, const Vec2& direction) {
  const Vec3 ahead(direction.x(), direction.y(), 0.0);
  std::vector<rays::Ray> ways;
  const Vec3 left(-direction.y(), direction.x(), 0.0);
  const auto look = [&](double aside, double turn) {  // m, rad
    for (const double height : kHeights) {
      ways.push_back({feet + aside * left + height * Vec3::UnitZ(),
                      from_rpy(0.0, 0.0, turn) * ahead, aside == 0.0 ? kOwn : 0.0, kHolds});
    }
  };
  for (const double turn : {0.0, -0.15, 0.15, -0.3, 0.3}) look(0.0, turn);
  for (const double aside : {-kBody, kBody}) look(aside, 0.0);
  std::vector<rays::Hit> hits;
  view.rays().cast(ways, hits, rays::kAll & ~rays::only(rays::Mobility::kStatic));
  const auto nearest =
      std::min_element(hits.begin(), hits.end(),
                       [](const rays::Hit& a, const rays::Hit& b) { return a.range < b.range; });
  return nearest->hit() ? view.model_of(nearest->shape) : "";
}

std::string Surroundings::model_at(const View& view, const Vec3& feet, const Vec2& point) {
  const Vec2 way = point - feet.head<2>();
  const std::vector<std::uint32_t> own = view.own_shapes();
  const Vec3 end(point.x() + kBeyond * way.normalized().x(),
                 point.y() + kBeyond * way.normalized().y(), feet.z());
  for (const double height : kHeights) {
    const Vec3 up = height * Vec3::UnitZ();
    for (const rays::Crossing& c : view.rays().crossings(
             feet + up, end + up, rays::kAll & ~rays::only(rays::Mobility::kStatic))) {
      const bool is_own = std::count(own.begin(), own.end(), c.shape) > 0;
      if (!is_own && std::abs(c.enter - way.norm()) < kBeyond) return view.model_of(c.shape);
    }
  }
  return "";
}

void Surroundings::remove_gone(const View& view, const Vec3& feet, std::vector<Vec2>& points) {
  const rays::Scene& scene = view.rays();
  const auto cast = [&](const rays::Ray& ray) {
    rays::Hit hit;
    scene.cast(&ray, &hit, 1);
    return hit;
  };
  const auto is_gone = [&](const Vec2& point) {
    const Vec2 way = point - feet.head<2>();
    const double length = way.norm();
    if (length > kSight) return false;
    const Vec3 direction(way.x() / length, way.y() / length, 0.0);
    const auto is_held = [&](double height) {  // the first one mostly meets it
      const Vec3 eye = feet + height * Vec3::UnitZ();
      return is_obstacle(cast({eye, direction, kOwn, length + kBeyond}));
    };
    return std::none_of(std::begin(kHeights), std::end(kHeights), is_held) &&
           cast(down_at(feet, point)).hit();
  };
  points.erase(std::remove_if(points.begin(), points.end(), is_gone), points.end());
}

double Surroundings::free_way(const Vec2& from, const Vec2& direction, double body) const {
  double least = kSight;
  double width = body;  // less beside an obstacle: along that it may walk on
  for (const Vec2& point : points_) width = std::min(width, (point - from).norm() - kGraze);
  for (const Vec2& point : points_) {
    const Vec2 to = point - from;
    const double along = direction.dot(to);
    const double aside = direction.x() * to.y() - direction.y() * to.x();
    if (along <= 0.0 || std::abs(aside) >= width) continue;
    least = std::min(least, along - std::sqrt(width * width - aside * aside));
  }
  return std::max(0.0, least);
}

bool Surroundings::is_free(const Vec2& from, const Vec2& to, double body) const {
  const double way = (to - from).norm();
  return way < 1e-6 || free_way(from, (to - from) / way, body) >= std::min(way, kSight);
}

bool Surroundings::is_occupied(const Vec2& place) const {
  return std::any_of(points_.begin(), points_.end(), [&](const Vec2& point) {
    return (point - place).squaredNorm() < kBody * kBody;
  });
}

std::optional<Vec2> Surroundings::to_nearest(const Vec2& from) const {
  const auto nearer = [&](const Vec2& a, const Vec2& b) {
    return (a - from).squaredNorm() < (b - from).squaredNorm();
  };
  const auto nearest = std::min_element(points_.begin(), points_.end(), nearer);
  if (nearest == points_.end()) return std::nullopt;
  return (*nearest - from).normalized();
}

bool Surroundings::reaches(const Vec2& from, const Vec2& to) const {
  if (is_free(from, to)) return true;
  Grid grid(from, points_);
  grid.spread({0.0, 0.0}, kBody);
  return (grid.place(grid.best(to)) - to).norm() < 2.0 * kCell;
}

std::optional<Vec2> Surroundings::way_aside(const Vec2& from, const Vec2& to) const {
  const Vec2 ahead = (to - from).normalized();
  const Vec2 right(ahead.y(), -ahead.x());
  for (double aside = kStepAside; aside > -1e-9; aside -= 0.5 * kCell) {
    for (const double on : kStepsAhead) {
      const Vec2 place = from + on * ahead + aside * right;
      if (on + aside > 0.5 * kCell - 1e-9 && is_free(from, place)) return place;
    }
  }
  return std::nullopt;
}

bool Surroundings::is_walkable(const View& view, const Vec3& feet, const Vec2& to) {
  const auto crossed = [&](const Vec3& from, const Vec3& end) {
    return view.rays().crossings(from, end, rays::only(rays::Mobility::kStatic));
  };
  const Vec2 way = to - feet.head<2>();
  const int steps = static_cast<int>(std::ceil(way.norm() / kSlopeStep));
  Vec3 last = feet;
  for (int i = 1; i <= steps; ++i) {
    const Vec2 place = feet.head<2>() + (static_cast<double>(i) / steps) * way;
    const Vec3 above(place.x(), place.y(), last.z() + 2.0 * kRise);
    const auto below = crossed(above, above - 4.0 * kRise * Vec3::UnitZ());
    if (below.empty() || below[0].normal.z() < kSlope) return false;
    const Vec3 next = above - below[0].enter * Vec3::UnitZ();
    if (std::abs(next.z() - last.z()) > kRise) return false;
    for (const double height : {kKneeHeight, kChest}) {
      const Vec3 up = height * Vec3::UnitZ();
      if (!crossed(last + up, next + up).empty()) return false;
    }
    if (!crossed(next + kHead * Vec3::UnitZ(), next + kLow * Vec3::UnitZ()).empty()) return false;
    last = next;
  }
  return has_room(view, last);
}

// At a distance from seen points, as it sees no more of an obstacle; close if there is no other
// way.
std::optional<Surroundings::Vec2> Surroundings::way_round(const Vec2& from, const Vec2& to) const {
  const double straight = (to - from).norm();
  if (straight < 1e-6) return std::nullopt;
  const Vec2 ahead = (to - from) / straight;
  Grid grid(from, points_);
  for (const double body : {kWide, kBody}) {
    grid.spread({-ahead.y(), ahead.x()}, body);
    const std::vector<int> way = grid.way_to(grid.best(to));
    const double left = (to - grid.place(way.back())).norm();
    const double length = kCell * static_cast<double>(way.size());
    if (straight - left < std::min(kNearer, 0.5 * straight)) continue;
    if (length > kLongestWay * (straight - left) + kExtra) continue;
    for (std::size_t i = way.size() - 1; i > 1; --i) {
      if (is_free(from, grid.place(way[i]), body)) return grid.place(way[i]);
    }
    return grid.place(way[std::min<std::size_t>(1, way.size() - 1)]);
  }
  return std::nullopt;
}

}  // namespace angen::people

#include "people/floor_map.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <queue>
#include <utility>

#include "core/lists.h"
#include "plugin/view.h"

namespace angen::people {

namespace {

constexpr rays::Mobilities kStatic = rays::only(rays::Mobility::kStatic);
constexpr double kScanHeights[] = {0.15, 0.45, 0.738, 1.2};  // m, as a person sees
constexpr double kProbeStep = 0.2;                           // m
constexpr double kDetour = 20.0;                             // m around both places
constexpr double kBorder = 1.0;                              // m around the static shapes
constexpr double kMaxMapCells = 4e6;
constexpr double kTightMap = 3.0;    // per meter nearer to something than kRoomyMap
constexpr double kInside = 0.3;      // m from the surface: deeper places need no distances
constexpr double kStep = 0.2;        // m up or down that a floor may be
constexpr double kGap = 0.15;        // m: one steps over it, as between a landing and a cabin
constexpr double kFloorStep = 0.01;  // m, of the heights of maps
constexpr double kStartAway = 1.0;   // m, at most, from a place without room to a free one

// The floor's height, so that a map serves feet that differ by some millimeters.
double floor_of(const Vec3& feet) { return kFloorStep * std::round(feet.z() / kFloorStep); }

// Around both places.
Eigen::AlignedBox2d ends_of(const Vec3& feet, const Eigen::Vector2d& to) {
  Eigen::AlignedBox2d ends(feet.head<2>().eval());
  ends.extend(to);
  const Eigen::Vector2d border = Eigen::Vector2d::Constant(kBorder);
  return {ends.min() - border, ends.max() + border};
}

double cross2(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

FloorMap::FloorMap(const View& view, const Vec3& feet, const Vec2& to, Extent extent) {
  const Eigen::AlignedBox2d ends = ends_of(feet, to);
  floor_ = floor_of(feet);
  revision_ = view.rays().static_revision();
  area_ = area(view, ends);
  Eigen::AlignedBox2d box = area_;
  if (box.volume() > kMaxMapCells * kCell * kCell) return;
  corner_ = box.min();
  if (extent == Extent::kStraight) {  // some of the same cells
    const Eigen::AlignedBox2d part = ends.intersection(box);
    const Vec2 skipped = ((part.min() - corner_) / kCell).array().floor();
    box = {corner_ + kCell * skipped, part.max()};
    corner_ = box.min();
    reach_ = static_cast<int>(kClearance / kCell) + 1;  // no way is searched
  }
  columns_ = static_cast<int>(std::ceil(box.sizes().x() / kCell)) + 1;
  rows_ = static_cast<int>(std::ceil(box.sizes().y() / kCell)) + 1;
  squares_.assign(static_cast<std::size_t>(columns_) * rows_, kRoomyMap * kRoomyMap);
  toll_.assign(squares_.size(), 0.0F);
  known_.assign(squares_.size(), 0);
  floored_ = std::make_shared<std::vector<char>>(squares_.size(), 0);
  scan({std::begin(kScanHeights), std::end(kScanHeights)}, view);
  scan(other_heights(view), view);
}

Eigen::AlignedBox2d FloorMap::area(const View& view, const Eigen::AlignedBox2d& ends) {
  const Vec2 detour = Vec2::Constant(kDetour - kBorder);
  const Eigen::AlignedBox2d box(ends.min() - detour, ends.max() + detour);
  const Eigen::AlignedBox3d all = view.rays().static_bounds();
  if (all.isEmpty()) return ends;
  const Eigen::AlignedBox2d standing(Vec2(all.min().head<2>()) - Vec2::Constant(kBorder),
                                     Vec2(all.max().head<2>()) + Vec2::Constant(kBorder));
  const Eigen::AlignedBox2d both = box.intersection(standing);
  return both.isEmpty() ? ends : both.merged(ends);
}

bool FloorMap::serves(const View& view, const Vec3& feet, const Vec2& to) const {
  if (revision_ != view.rays().static_revision() || floor_ != floor_of(feet)) return false;
  const Eigen::AlignedBox2d other = area(view, ends_of(feet, to));
  return other.min() == area_.min() && other.max() == area_.max();
}

// Edges of tops and boards over free places, which are between the heights of the scan.
std::vector<double> FloorMap::other_heights(const View& view) const {
  std::vector<double> heights;
  const int step = static_cast<int>(kProbeStep / kCell);
  for (int y = 0; y < rows_; y += step) {
    for (int x = 0; x < columns_; x += step) {
      const int cell = y * columns_ + x;
      if (gap(cell) < kClearance) continue;
      const Vec2 at = place(cell);
      const auto crossed = view.rays().crossings({at.x(), at.y(), floor_ + kHead},
                                                 {at.x(), at.y(), floor_ + kLow}, kStatic);
      for (const rays::Crossing& c : crossed) {
        heights.push_back(kFloorStep *
                          std::round((kHead - 0.5 * (c.enter + c.leave)) / kFloorStep));
      }
    }
  }
  sort_unique(heights);
  return heights;
}

void FloorMap::scan(const std::vector<double>& heights, const View& view) {
  if (heights.empty()) return;
  for (const int axis : {0, 1}) scan_lines(heights, view, axis);
}

// Lines along both axes, so that none of two is along a thin wall.
void FloorMap::scan_lines(const std::vector<double>& heights, const View& view, int axis) {
  const int lines = axis == 0 ? rows_ : columns_;
  const double length = kCell * ((axis == 0 ? columns_ : rows_) - 1);
  const Vec2 ahead = Vec2::Unit(axis);
  std::vector<std::pair<double, double>> spans;
  for (int line = 0; line < lines; ++line) {
    Vec2 from = corner_;
    from[1 - axis] += line * kCell;
    const Vec2 to = from + length * ahead;
    spans.clear();
    for (const double height : heights) {
      const double z = floor_ + height;
      for (const rays::Crossing& c :
           view.rays().crossings({from.x(), from.y(), z}, {to.x(), to.y(), z}, kStatic)) {
        spans.emplace_back(c.enter, c.leave);
      }
    }
    sort_unique(spans);  // most walls are alike at all heights
    for (const auto& [enter, leave] : spans) add_span(from + enter * ahead, from + leave * ahead);
  }
}

void FloorMap::add_span(const Vec2& enter, const Vec2& leave) {
  const double length = (leave - enter).norm();
  const Vec2 ahead = length > 0.0 ? Vec2((leave - enter) / length) : Vec2::Zero();
  for (double at = 0.0; at < length; at += kCell) {
    if (std::min(at, length - at) < kInside) {
      add_point(enter + at * ahead);
    } else if (const std::optional<int> cell = cell_at(enter + at * ahead)) {
      squares_[*cell] = 0.0;
    }
  }
  add_point(leave);
}

void FloorMap::add_points(const std::vector<Vec2>& points) {
  for (const Vec2& point : points) add_point(point);
}

void FloorMap::add_point(const Vec2& point) {
  const int middle_x = column(point.x());
  const int middle_y = row(point.y());
  const int first = std::max(0, middle_x - reach_);
  const int last = std::min(columns_ - 1, middle_x + reach_);
  for (int y = std::max(0, middle_y - reach_); y <= std::min(rows_ - 1, middle_y + reach_); ++y) {
    const double away = corner_.y() + kCell * y - point.y();
    const double start = corner_.x() - point.x();
    double* row = squares_.data() + static_cast<std::size_t>(y) * columns_;
    for (int x = first; x <= last; ++x) {  // the compiler makes vectors of it
      const double aside = start + kCell * x;
      row[x] = std::min(row[x], aside * aside + away * away);
    }
  }
}

void FloorMap::add_toll(const Vec2& from, const Vec2& to, double toll) {
  const double length = (to - from).norm();
  const Vec2 along = (to - from) / length;
  const int reach = static_cast<int>(length / kCell) + 2;
  const int middle_x = column(0.5 * (from.x() + to.x()));
  const int middle_y = row(0.5 * (from.y() + to.y()));
  for (int y = std::max(0, middle_y - reach); y <= std::min(rows_ - 1, middle_y + reach); ++y) {
    for (int x = std::max(0, middle_x - reach); x <= std::min(columns_ - 1, middle_x + reach);
         ++x) {
      const Vec2 offset = place(y * columns_ + x) - from;
      const double at = along.dot(offset);
      if (at < 0.0 || at > length || std::abs(cross2(along, offset)) > kCell) continue;
      toll_[y * columns_ + x] = static_cast<float>(0.5 * toll);  // two cells are on the way across
    }
  }
}

int FloorMap::column(double x) const {
  return static_cast<int>(std::lround((x - corner_.x()) / kCell));
}

int FloorMap::row(double y) const {
  return static_cast<int>(std::lround((y - corner_.y()) / kCell));
}

std::optional<int> FloorMap::cell_at(const Vec2& place) const {
  const int x = column(place.x());
  const int y = row(place.y());
  if (x < 0 || y < 0 || x >= columns_ || y >= rows_) return std::nullopt;
  return y * columns_ + x;
}

FloorMap::Vec2 FloorMap::place(int cell) const {
  return corner_ + kCell * Vec2(cell % columns_, cell / columns_);
}

bool FloorMap::is_free(const Vec2& place) const {
  const std::optional<int> cell = cell_at(place);
  return !cell || gap(*cell) >= kClearance;
}

bool FloorMap::is_clear(const Vec2& from, const Vec2& to) const {
  const double length = (to - from).norm();
  const int steps = static_cast<int>(length / (0.5 * kCell)) + 1;
  for (int i = 0; i <= steps; ++i) {
    if (!is_free(from + (to - from) * (static_cast<double>(i) / steps))) return false;
  }
  return true;
}

std::optional<int> FloorMap::free_cell(const Vec2& near, double reach) const {
  const int cells = static_cast<int>(reach / kCell) + 1;
  std::optional<int> best;
  double least = reach;
  for (int y = row(near.y()) - cells; y <= row(near.y()) + cells; ++y) {
    for (int x = column(near.x()) - cells; x <= column(near.x()) + cells; ++x) {
      if (x < 0 || y < 0 || x >= columns_ || y >= rows_) continue;
      const int cell = y * columns_ + x;
      const double away = (place(cell) - near).norm();
      if (away >= least || gap(cell) < kClearance) continue;
      least = away;
      best = cell;
    }
  }
  return best;
}

// The cost of a meter of way through the cell.
double FloorMap::rate(int cell) const {
  return 1.0 + kTightMap * std::max(0.0, kRoomyMap - static_cast<double>(gap(cell)));
}

float FloorMap::gap(int cell) const { return static_cast<float>(std::sqrt(squares_[cell])); }

// Ways lead over floor only.
bool FloorMap::can_stand(const View& view, int cell) {
  if (gap(cell) < kClearance) return false;
  if (std::exchange(known_[cell], 1) != 0) return true;
  char& is_floored = (*floored_)[cell];
  if (is_floored != 0) return true;
  const rays::Ray down = down_at(place(cell));
  rays::Hit hit;
  view.rays().cast(&down, &hit, 1, kStatic);
  if (hit.hit()) {
    is_floored = 1;
    return true;
  }
  view.rays().cast(&down, &hit, 1);
  if (!hit.hit()) squares_[cell] = 0.0;
  return hit.hit();
}

rays::Ray FloorMap::down_at(const Vec2& place) const {
  return {Vec3(place.x(), place.y(), floor_ + kStep), -Vec3::UnitZ(), 0.0, 2.0 * kStep};
}

bool FloorMap::has_floor(const View& view, const Vec2& from, const Vec2& to) const {
  const int steps = static_cast<int>((to - from).norm() / kCell) + 1;
  std::vector<rays::Ray> down;
  for (int i = 0; i <= steps; ++i) {
    down.push_back(down_at(from + (to - from) * (static_cast<double>(i) / steps)));
  }
  std::vector<rays::Hit> hits;
  view.rays().cast(down, hits);
  int missing = 0;
  for (const rays::Hit& hit : hits) {
    missing = hit.hit() ? 0 : missing + 1;
    if (missing * kCell > kGap) return false;
  }
  return missing == 0;
}

/// A* over the free cells.
struct FloorMap::Search {
  struct Entry {
    double estimate;
    double cost;
    int cell;
    bool operator>(const Entry& o) const {
      return estimate != o.estimate ? estimate > o.estimate : cell > o.cell;
    }
  };
  std::vector<double> cost;
  std::vector<int> from;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;

  explicit Search(std::size_t cells)
      : cost(cells, std::numeric_limits<double>::infinity()), from(cells, -1) {}

  template <class Rest>
  void reach(int cell, double at, int by, const Rest& rest) {
    if (at >= cost[cell]) return;
    cost[cell] = at;
    from[cell] = by;
    open.push({at + rest(cell), at, cell});
  }
};

std::optional<std::vector<FloorMap::Vec2>> FloorMap::way(const View& view, const Vec2& from,
                                                         const Vec2& to, double tolerance) {
  if (squares_.empty()) return std::vector<Vec2>{to};  // too far for a map: it tries
  const std::optional<int> start = free_cell(from, kStartAway);
  const std::optional<int> goal = free_cell(to, tolerance);
  if (!start || !goal) return std::nullopt;
  Search search(squares_.size());
  const auto rest = [&](int cell) { return (place(cell) - place(*goal)).norm(); };
  const double lengths[] = {0.0, kCell, kCell * std::hypot(1.0, 1.0)};  // m, of a step
  search.reach(*start, 0.0, -1, rest);
  while (!search.open.empty()) {
    const Search::Entry now = search.open.top();
    search.open.pop();
    if (now.cell == *goal) break;
    if (now.cost > search.cost[now.cell]) continue;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = now.cell % columns_ + dx;
        const int y = now.cell / columns_ + dy;
        if (x < 0 || y < 0 || x >= columns_ || y >= rows_) continue;
        const int next = y * columns_ + x;
        const double length = lengths[std::abs(dx) + std::abs(dy)];
        if (now.cost + length >= search.cost[next]) continue;  // no rate is below 1
        if (!can_stand(view, next)) continue;
        const double more = length * rate(next) + toll_[next];
        search.reach(next, now.cost + more, now.cell, rest);
      }
    }
  }
  if (!std::isfinite(search.cost[*goal])) return std::nullopt;
  std::vector<Vec2> way{to};
  for (int cell = *goal; cell >= 0; cell = search.from[cell]) way.push_back(place(cell));
  std::reverse(way.begin(), way.end());
  return way;
}

}  // namespace angen::people

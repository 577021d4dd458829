#include "sensors/pir/heat.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plugin/rooms.h"
#include "plugin/view.h"

namespace angen::sensors {

namespace {

constexpr double kTurn = 2.0 * M_PI;
constexpr double kStefanBoltzmann = 5.670374419e-8;  // W/m^2 K^4, CODATA 2018
constexpr double kHousing = 0.05;                    // m: the detector's own housing is not seen
constexpr double kCellWidth = 0.012;                 // rad, at least: a third of a zone
constexpr double kCellHeight = 0.024;
constexpr double kZoneCells = 3.0;
constexpr int kFewest = 12;  // cells on a side
constexpr int kMaxCells = 64;
constexpr double kSameAir = 0.01;                    // K
constexpr double kWatchCell = 0.02;                  // rad between the rays that bound its view
constexpr std::size_t kEach = 4;                     // one of so many rays to a surface is probed
constexpr std::size_t kFewProbed = 24;               // fewer rays are all tested
constexpr Nanoseconds kHiddenPeriod = kSecond / 20;  // while all surfaces are hidden
constexpr std::size_t kMaxScans = 64;
constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();

double fourth_power(double x) { return x * x * x * x; }

double azimuth_of(const Vec3& p) { return std::atan2(p.y(), p.x()); }

/// A window about the x axis of `pose` that contains the box; `whole` where it surrounds the
/// detector. Azimuths are near that of the box's middle, also beyond pi.
Window window_of(const Eigen::AlignedBox3d& box, const Pose& pose, const Window& whole) {
  if (box.contains(pose.position)) return whole;
  const Pose inverse = pose.inverse();
  const double middle = azimuth_of(inverse * Vec3(box.center()));
  Window window{kTurn, -kTurn, kTurn, -kTurn};
  // Corners are not enough: a box in front is highest in the middle of an edge.
  for (int column = 0; column < 9; ++column) {
    Vec3 before = Vec3::Constant(kNowhere);
    double away = 0.0;
    for (int level = 0; level < 3; ++level) {
      const Vec3 part(column % 3 / 2.0, column / 3 / 2.0, level / 2.0);
      const Vec3 p = inverse * Vec3(box.min() + part.cwiseProduct(box.sizes()));
      if (p.x() != before.x() || p.y() != before.y()) {  // all levels are alike if it is upright
        const double azimuth = middle + std::remainder(azimuth_of(p) - middle, kTurn);
        window.right = std::min(window.right, azimuth);
        window.left = std::max(window.left, azimuth);
        away = std::hypot(p.x(), p.y());
        before = p;
      }
      const double elevation = std::atan2(p.z(), away);
      window.low = std::min(window.low, elevation);
      window.high = std::max(window.high, elevation);
    }
  }
  return window.left - window.right > M_PI ? whole : window;
}

/// The intersection of two windows, one turned to the left by `turn`; right >= left if empty.
Window common(const Window& a, const Window& b, double turn) {
  return {std::max(a.right, b.right + turn), std::min(a.left, b.left + turn),
          std::max(a.low, b.low), std::min(a.high, b.high)};
}

Vec3 direction_to(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

int cells(double angle, double size) {
  return std::clamp(static_cast<int>(std::ceil(angle / size)), kFewest, kMaxCells);
}

}  // namespace

Heat::Heat(FresnelLens lens, double range, double opening, Nanoseconds period)
    : lens_(std::move(lens)),
      cell_width_(std::max(kCellWidth, lens_.narrowest() / kZoneCells)),
      cell_height_(std::max(kCellHeight, lens_.lowest() / kZoneCells)),
      range_(range),
      opening_(opening),
      period_(period) {}

double HeatSources::flux(Nanoseconds time) const {
  double sum = 0.0;
  for (const Source& source : all) {
    if (source.factor == 0.0) continue;  // hidden
    sum += (fourth_power(source.course.at(time)) - air_fourth) * source.factor;
  }
  return kStefanBoltzmann / M_PI * sum;
}

bool HeatSources::operator==(const HeatSources& o) const {
  return air_fourth == o.air_fourth &&
         std::equal(all.begin(), all.end(), o.all.begin(), o.all.end(),
                    [](const Source& a, const Source& b) {
                      return a.factor == b.factor && a.course == b.course;
                    });
}

bool HeatSources::constant(Nanoseconds time) const {
  return std::all_of(all.begin(), all.end(), [&](const Source& source) {
    return source.factor == 0.0 || source.course.at(time) == source.course.limit;
  });
}

void Heat::sample(const View& view) {
  const Pose pose = view.pose();
  const Revisions now = view.watch([&] { return all_rays(pose); });
  const bool still = now.shapes == revisions_.shapes && pose == pose_;
  const bool was_set = std::exchange(revisions_.temperatures, now.temperatures) != now.temperatures;
  if (still && rests_ && !was_set) return;
  rests_ = false;
  if (still) {
    const bool has_other_air = follow_air(view);
    if (!(was_set || has_other_air) || reheat(view)) return;
  }
  pending_ = waits(view.time());
  if (pending_) return;
  follow_air(view);
  revisions_.shapes = now.shapes;
  look_from(pose);
  shapes_.clear();
  radiating_.all.clear();
  near_ = false;
  most_ = 0.0;
  for (const rays::WarmShape& shape : view.warm_shapes()) {
    if (!radiates(shape, view.time())) continue;
    shapes_.push_back(shape.shape);
    radiating_.all.push_back({factor_of(shape, view), shape.course});
  }
  publish_sources();
}

bool Heat::radiates(const rays::WarmShape& shape, Nanoseconds now) const {
  return shape.course.at(now) != air_ || shape.course.limit != air_;
}

// While only temperatures change, hits stay the same. False where a surface radiates that did not
// when it was sampled.
bool Heat::reheat(const View& view) {
  std::size_t next = 0;
  for (const rays::WarmShape& shape : view.warm_shapes()) {  // shapes_ has some, in this order
    if (next < shapes_.size() && shapes_[next] == shape.shape) {
      radiating_.all[next++].course = shape.course;
    } else if (radiates(shape, view.time())) {
      return false;
    }
  }
  publish_sources();
  return true;
}

void Heat::publish_sources() {
  if (!(*sources_ == radiating_)) sources_ = std::make_shared<HeatSources>(radiating_);
}

// Follows the air of its room, or the world's if the room has no climate. Whether it has changed.
bool Heat::follow_air(const View& view) {
  const Nanoseconds now = view.time() / kSecond;
  if (now == felt_at_) return false;
  felt_at_ = now;
  const double air = air_temperature(view, view.pose().position);
  if (std::abs(air - air_) < kSameAir) return false;
  const double before = radiating_.flux(view.time());
  air_ = air;
  radiating_.air_fourth = fourth_power(air);
  drift_ += radiating_.flux(view.time()) - before;
  publish_sources();
  return true;
}

// Surfaces behind something are sampled less often, whenever they were sampled before.
bool Heat::waits(Nanoseconds now) const {
  return near_ && flux_ == 0.0 && now / kHiddenPeriod == (now - period_) / kHiddenPeriod;
}

std::vector<rays::Ray> Heat::all_rays(const Pose& pose) const {
  const Window& window = lens_.window();
  const int columns = std::max(1, static_cast<int>((window.left - window.right) / kWatchCell));
  const int rows = std::max(1, static_cast<int>((window.high - window.low) / kWatchCell));
  std::vector<rays::Ray> rays;
  for (int row = 0; row <= rows; ++row) {
    const double elevation = window.low + (window.high - window.low) * row / rows;
    for (int column = 0; column <= columns; ++column) {
      const double azimuth = window.right + (window.left - window.right) * column / columns;
      rays.push_back(
          {pose.position, pose.rotation * direction_to(azimuth, elevation), kHousing, range_});
    }
  }
  return rays;
}

void Heat::look_from(const Pose& pose) {
  if (!(pose == pose_)) scans_.clear();
  pose_ = pose;
  rotation_ = pose.rotation.toRotationMatrix();
  const Window& window = lens_.window();
  cone_ = 0.5 * std::hypot(window.left - window.right, window.high - window.low);
  axis_ = pose.rotation *
          direction_to(0.5 * (window.left + window.right), 0.5 * (window.low + window.high));
}

// False only where the ball around the box is beside the cone around the window.
bool Heat::sees(const Eigen::AlignedBox3d& box) const {
  const Vec3 way = box.center() - pose_.position;
  const double away = way.norm();
  const double radius = 0.5 * box.sizes().norm();
  if (away <= radius || cone_ >= M_PI_2) return true;
  const double angle = std::acos(std::clamp(axis_.dot(way) / away, -1.0, 1.0));
  return angle <= cone_ + std::asin(radius / away);
}

/// m^2 sr: the share of a surface's radiance that reaches the elements' difference.
double Heat::factor_of(const rays::WarmShape& shape, const View& view) {
  if (shape.box.isEmpty() || shape.box.exteriorDistance(pose_.position) > range_) return 0.0;
  if (!sees(shape.box)) return 0.0;
  Scan& found = scan_of(shape);
  if (found.windows && found.windows->empty()) return 0.0;
  const rays::Scene& rays = view.rays();
  const Eigen::AlignedBox3d between = Eigen::AlignedBox3d(found.box).extend(pose_.position);
  if (!found.is_known || rays.moved_since(found.moment, between)) {
    const double before = std::exchange(found.factor, look_at(shape.shape, found, rays));
    const double contrast = fourth_power(shape.course.at(view.time())) - fourth_power(air_);
    const double change = std::abs((found.factor - before) * contrast);
    if (change > most_) {
      most_ = change;
      mover_ = shape.shape;
    }
  }
  found.moment = rays.moment();
  found.is_known = true;
  near_ = near_ || !windows_of(found).empty();
  return found.factor;
}

double Heat::look_at(std::uint32_t shape, Scan& found, const rays::Scene& rays) const {
  if (rays.blocks(found.wall, pose_.position, kHousing, shape)) {
    found.blockers.reset();
    return 0.0;
  }
  if (windows_of(found).empty()) return 0.0;
  const rays::Shaft shaft = rays.shaft(pose_.position, kHousing, shape);
  const std::optional<std::uint64_t> before = std::exchange(found.blockers, shaft.fingerprint());
  return before == found.blockers ? found.factor : seen_factor(shaft, found);
}

Heat::Scan& Heat::scan_of(const rays::WarmShape& shape) {
  if (scans_.size() > kMaxScans) scans_.clear();
  const auto [at, is_new] = scans_.try_emplace(shape.shape);
  Scan& found = at->second;
  const bool rests = !is_new && found.box.min() == shape.box.min() &&
                     found.box.max() == shape.box.max() && found.rotation == shape.rotation;
  if (rests) return found;
  const std::uint32_t wall = found.wall;
  const double factor = found.factor;
  found = Scan{};
  found.wall = wall;
  found.factor = factor;
  found.box = shape.box;
  found.rotation = shape.rotation;
  return found;
}

// They are computed when first needed; a surface that stays hidden needs none.
const std::vector<Window>& Heat::windows_of(Scan& found) const {
  if (found.windows) return *found.windows;
  found.windows.emplace();
  const Window around = window_of(found.box, pose_, lens_.window());
  for (const double turn : {0.0, kTurn, -kTurn}) {
    const Window seen = common(lens_.window(), around, turn);
    if (seen.right < seen.left && seen.low < seen.high) found.windows->push_back(seen);
  }
  return *found.windows;
}

double Heat::seen_factor(const rays::Shaft& shaft, Scan& found) const {
  found.wall = shaft.blocked_by();
  if (found.wall != UINT32_MAX) return 0.0;
  if (found.parts.empty()) {
    for (const Window& seen : windows_of(found)) found.parts.push_back(scan(seen, shaft));
  }
  double sum = 0.0;
  for (const std::vector<Cell>& cells : found.parts) sum += visible(cells, shaft);
  return sum;
}

rays::Ray Heat::ray_to(const Cell& cell) const {
  const Vec3 way(cell.level * std::cos(cell.azimuth), cell.level * std::sin(cell.azimuth), cell.up);
  return {pose_.position, (rotation_ * way).normalized(), kHousing, range_};
}

// A grid that moves with the shape, so that its outline makes no noise.
std::vector<Heat::Cell> Heat::scan(const Window& seen, const rays::Shaft& shaft) const {
  const int columns = cells(seen.left - seen.right, cell_width_);
  const int rows = cells(seen.high - seen.low, cell_height_);
  const double width = (seen.left - seen.right) / columns;
  const double height = (seen.high - seen.low) / rows;
  std::vector<Cell> found;
  found.reserve(static_cast<std::size_t>(columns) * rows);
  FresnelLens::Line line;
  for (int row = 0; row < rows; ++row) {
    const double elevation = seen.low + (row + 0.5) * height;
    lens_.find_line(elevation, line);
    if (line.empty()) continue;
    const double level = std::cos(elevation);
    const double up = std::sin(elevation);
    const double shift = std::fmod(0.5 + row * 0.6180339887498949, 1.0);  // no edge falls on all
    const std::size_t first = found.size();
    for (int column = 0; column < columns; ++column) {
      const double azimuth = seen.right + (column + shift) * width;
      const double sensitivity = line.sensitivity(azimuth);
      if (sensitivity == 0.0) continue;
      const double solid_angle = width * height * level;
      found.push_back({azimuth, level, up, solid_angle * sensitivity * opening_});
    }
    const auto misses = [&](const Cell& cell) { return !shaft.reaches(ray_to(cell)); };
    // A convex shape fills the row between two of its cells.
    while (found.size() > first && misses(found.back())) found.pop_back();
    const auto begin = found.begin() + static_cast<std::ptrdiff_t>(first);
    found.erase(begin, std::find_if_not(begin, found.end(), misses));
  }
  return found;
}

// Mostly all or nothing of a surface is in sight: some of its rays tell that, and save the others.
double Heat::visible(const std::vector<Cell>& cells, const rays::Shaft& shaft) const {
  const auto is_seen = [&](const Cell& cell) { return shaft.sees(ray_to(cell)); };
  std::size_t probed = 0;
  std::size_t seen = 0;
  if (!shaft.clear() && cells.size() >= kFewProbed) {
    for (std::size_t i = 0; i < cells.size(); i += kEach, ++probed) seen += is_seen(cells[i]);
    if (seen == 0) return 0.0;
  }
  const bool whole = shaft.clear() || (probed > 0 && seen == probed);
  double sum = 0.0;
  for (const Cell& cell : cells) {
    if (whole || is_seen(cell)) sum += cell.factor;
  }
  return sum;
}

double Heat::flux(Nanoseconds now) {
  flux_ = radiating_.flux(now);
  return flux_;
}

}  // namespace angen::sensors

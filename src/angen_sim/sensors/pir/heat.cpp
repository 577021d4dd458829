#include "sensors/pir/heat.h"

#include <algorithm>
#include <cmath>

#include "plugin/rooms.h"

namespace angen::sensors {

namespace {

constexpr double kTurn = 2.0 * M_PI;
constexpr double kStefanBoltzmann = 5.670374419e-8;  // W/m^2 K^4, CODATA 2018
constexpr double kHousing = 0.05;                    // m: the detector's own housing is not seen
constexpr double kCellWidth = 0.012;                 // rad: a third of a zone of a wide lens
constexpr double kCellHeight = 0.024;
constexpr int kFewest = 12;  // cells on a side
constexpr int kMaxCells = 64;
constexpr double kSameAir = 0.01;        // K
constexpr double kZeroCelsius = 273.15;  // K
constexpr int kWaits = 4;                // samples left out while all surfaces are hidden

double azimuth_of(const Vec3& p) { return std::atan2(p.y(), p.x()); }

/// A window about the x axis of `pose` that holds the box; `whole` where it surrounds the detector.
/// Azimuths are near that of the box's middle, also beyond pi.
Window window_of(const Eigen::AlignedBox3d& box, const Pose& pose, const Window& whole) {
  if (box.contains(pose.position)) return whole;
  const Pose inverse = pose.inverse();
  const double middle = azimuth_of(inverse * Vec3(box.center()));
  Window window{kTurn, -kTurn, kTurn, -kTurn};
  // Corners are not enough: a box in front is highest in the middle of an edge.
  for (int i = 0; i < 27; ++i) {
    const Vec3 part(i % 3 / 2.0, i / 3 % 3 / 2.0, i / 9 / 2.0);
    const Vec3 p = inverse * Vec3(box.min() + part.cwiseProduct(box.sizes()));
    const double azimuth = middle + std::remainder(azimuth_of(p) - middle, kTurn);
    const double elevation = std::atan2(p.z(), std::hypot(p.x(), p.y()));
    window.right = std::min(window.right, azimuth);
    window.left = std::max(window.left, azimuth);
    window.low = std::min(window.low, elevation);
    window.high = std::max(window.high, elevation);
  }
  return window.left - window.right > M_PI ? whole : window;
}

/// The intersection of two windows, one turned to the left by `turn`; right >= left if empty.
Window common(const Window& a, const Window& b, double turn) {
  return {std::max(a.right, b.right + turn), std::min(a.left, b.left + turn),
          std::max(a.low, b.low), std::min(a.high, b.high)};
}

/// W/(m^2 sr) that a surface of that temperature (K) sends out more than the air.
double radiance_over(double air, double temperature) {
  return kStefanBoltzmann / M_PI * (std::pow(temperature, 4) - std::pow(air, 4));
}

int cells(double angle, double size) {
  return std::clamp(static_cast<int>(std::ceil(angle / size)), kFewest, kMaxCells);
}

}  // namespace

void Heat::aim(const View& view, RayBatch& rays) {
  const Pose pose = view.pose();
  sampled_ = false;
  const bool as_warm = view.surface_revision() == surface_revision_;
  const bool still = view.scene_revision() == revision_ && pose == pose_;
  if (still && as_warm) return;
  if (still) {
    follow_air(view);
    if (reheat(view)) return;
  }
  if (unseen_lately()) return;
  follow_air(view);
  sampled_ = true;
  revision_ = view.scene_revision();
  surface_revision_ = view.surface_revision();
  pose_ = pose;
  surfaces_.clear();
  samples_.clear();
  for (const rays::WarmShape& shape : view.warm_shapes()) {
    if (shape.temperature == air_) continue;
    surfaces_.push_back({shape.shape, shape.temperature});
    aim_at(shape.box, pose, rays);
  }
}

// While only temperatures change, hits stay the same. False where a surface radiates
// that did not when it was sampled.
bool Heat::reheat(const View& view) {
  std::size_t next = 0;
  for (const rays::WarmShape& shape : view.warm_shapes()) {  // surfaces_ has some, in this order
    if (next < surfaces_.size() && surfaces_[next].shape == shape.shape) {
      surfaces_[next++].temperature = shape.temperature;
    } else if (shape.temperature != air_) {
      return false;
    }
  }
  surface_revision_ = view.surface_revision();
  sum_up();
  return true;
}

void Heat::sum_up() {
  flux_ = 0.0;
  for (const Surface& surface : surfaces_) {
    flux_ += radiance_over(air_, surface.temperature) * surface.factor;
  }
}

// Of its room, or the world's where that has no climate.
void Heat::follow_air(const View& view) {
  const Nanoseconds now = view.time() / kSecond;
  if (now == felt_at_) return;
  felt_at_ = now;
  const double here = air_at(view, view.pose().position).temperature + kZeroCelsius;
  const double air = std::isnan(here) ? view.ambient_temperature() : here;
  if (std::abs(air - air_) < kSameAir) return;
  const double before = flux_;
  air_ = air;
  sum_up();
  drift_ += flux_ - before;
}

// Surfaces behind a wall are sampled less often.
bool Heat::unseen_lately() {
  const bool hidden = !samples_.empty() && flux_ == 0.0;
  if (hidden && waits_ < kWaits) {
    ++waits_;
    return true;
  }
  waits_ = 0;
  return false;
}

void Heat::aim_at(const Eigen::AlignedBox3d& box, const Pose& pose, RayBatch& rays) {
  if (box.isEmpty() || box.exteriorDistance(pose.position) > range_) return;
  const Window around = window_of(box, pose, lens_.window());
  for (const double turn : {0.0, kTurn, -kTurn}) {
    const Window seen = common(lens_.window(), around, turn);
    if (seen.right < seen.left && seen.low < seen.high) scan(seen, pose, rays);
  }
}

// A grid of rays that moves with the shape, so that its outline makes no noise.
void Heat::scan(const Window& seen, const Pose& pose, RayBatch& rays) {
  const int columns = cells(seen.left - seen.right, kCellWidth);
  const int rows = cells(seen.high - seen.low, kCellHeight);
  const double width = (seen.left - seen.right) / columns;
  const double height = (seen.high - seen.low) / rows;
  const Eigen::Matrix3d rotation = pose.rotation.toRotationMatrix();
  for (int row = 0; row < rows; ++row) {
    const double elevation = seen.low + (row + 0.5) * height;
    const double shift = std::fmod(0.5 + row * 0.6180339887498949, 1.0);  // no edge falls on all
    for (int column = 0; column < columns; ++column) {
      const double azimuth = seen.right + (column + shift) * width;
      const double sensitivity = lens_.sensitivity(azimuth, elevation);
      if (sensitivity == 0.0) continue;
      const Vec3 direction(std::cos(elevation) * std::cos(azimuth),
                           std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const double solid_angle = width * height * std::cos(elevation);
      rays.push_back({pose.position, (rotation * direction).normalized(), kHousing, range_});
      samples_.push_back({surfaces_.size() - 1, solid_angle * sensitivity * opening_});
    }
  }
}

double Heat::flux(Hits hits) {
  if (!sampled_) return flux_;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    Surface& surface = surfaces_[samples_[i].surface];
    if (hits[i].shape == surface.shape) surface.factor += samples_[i].factor;
  }
  sum_up();
  return flux_;
}

}  // namespace angen::sensors

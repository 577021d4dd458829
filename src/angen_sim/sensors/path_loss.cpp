#include "sensors/path_loss.h"

#include <algorithm>
#include <cmath>

namespace angen::sensors {

namespace {

constexpr double kLightSpeed = 299.792458;  // m/us: m times MHz
constexpr double kNearest = 0.1;            // m: nearer is not the far field
constexpr double kThinnest = 0.01;          // m: boards and sheets let waves through
constexpr double kLight = 0.125;            // m: thicker walls are heavy
constexpr double kThickestWall = 0.5;       // m: thicker things are hollow, as wardrobes
constexpr double kLevel = 0.7;              // z of a normal: steeper surfaces are walls
constexpr double kTouch = 1e-3;             // m: gap of shapes that touch
constexpr float kParallel = 0.99F;          // cosine between faces of boards that are one wall

void count(double inside, const rays::Crossing& piece, const Vec3& way, Obstacles& obstacles) {
  const double thickness = inside * std::abs(piece.normal.cast<double>().dot(way));
  if (thickness < kThinnest) return;
  if (thickness <= kLight || thickness > kThickestWall) {
    ++obstacles.light;
  } else if (std::abs(piece.normal.z()) > kLevel) {
    ++obstacles.floors;
  } else {
    ++obstacles.heavy;
  }
}

/// Whether a wall goes on in the next piece: they overlap, or are boards that touch face to face.
bool joins(const rays::Crossing& first, double leave, const rays::Crossing& next, const Vec3& way) {
  if (next.enter < leave - kTouch) return true;
  if (next.enter > leave + kTouch) return false;
  const double both = (next.leave - first.enter) * std::abs(first.normal.cast<double>().dot(way));
  return std::abs(first.normal.dot(next.normal)) > kParallel && both <= kThickestWall;
}

}  // namespace

double free_space_loss(double distance, double frequency) {
  return 20.0 * std::log10(4.0 * M_PI * std::max(distance, kNearest) * frequency / kLightSpeed);
}

Obstacles obstacles_on(const std::vector<rays::Crossing>& crossings, const Vec3& way) {
  Obstacles found;
  for (std::size_t i = 0; i < crossings.size();) {
    const rays::Crossing& first = crossings[i];
    double leave = first.leave;
    for (++i; i < crossings.size() && joins(first, leave, crossings[i], way); ++i) {
      leave = std::max(leave, crossings[i].leave);
    }
    count(leave - first.enter, first, way, found);
  }
  return found;
}

double loss_of(const Obstacles& obstacles, const PathLoss& losses) {
  double loss = obstacles.light * losses.light_wall + obstacles.heavy * losses.heavy_wall;
  const double floors = obstacles.floors;
  if (floors > 0.0) {
    const double exponent = (floors + 2.0) / (floors + 1.0) - losses.floor_exponent;
    loss += losses.floor * std::pow(floors, exponent);
  }
  return loss;
}

}  // namespace angen::sensors

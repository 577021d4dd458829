#include "light/photometry.h"

#include <algorithm>
#include <cmath>

namespace angen::light {
namespace {

struct Between {
  std::size_t low = 0;
  double share = 0.0;  // share of the next one
};

Between between(const std::vector<double>& angles, double angle) {
  if (angles.size() < 2 || angle <= angles.front()) return {};
  const auto above = std::upper_bound(angles.begin(), angles.end(), angle);
  if (above == angles.end()) return {angles.size() - 2, 1.0};
  const auto low = static_cast<std::size_t>(above - angles.begin()) - 1;
  return {low, (angle - angles[low]) / (angles[low + 1] - angles[low])};
}

/// The angle about the axis, folded by the symmetry of the given planes: none, halves or quarters.
double folded(double about, double last) {
  double angle = std::fmod(about, 2.0 * M_PI);
  if (angle < 0.0) angle += 2.0 * M_PI;
  if (last < 1.5 * M_PI && angle > M_PI) angle = 2.0 * M_PI - angle;
  if (last < 0.75 * M_PI && angle > M_PI / 2) angle = M_PI - angle;
  return angle;
}

/// The integral of I sin(angle) over one plane, with I linear between the given angles.
double over_plane(const Photometry& luminaire, std::size_t plane) {
  const std::vector<double>& angles = luminaire.vertical;
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
    const double a = angles[i], b = angles[i + 1];
    const double at_a = luminaire.candela[plane * angles.size() + i];
    const double slope = (luminaire.candela[plane * angles.size() + i + 1] - at_a) / (b - a);
    sum += at_a * (std::cos(a) - std::cos(b)) +
           slope * (std::sin(b) - std::sin(a) - (b - a) * std::cos(b));
  }
  return sum;
}

}  // namespace

double intensity(const Photometry& luminaire, double vertical, double about) {
  const std::vector<double>& angles = luminaire.vertical;
  if (vertical < angles.front() - 1e-9 || vertical > angles.back() + 1e-9) return 0.0;
  const Between row = between(angles, vertical);
  const Between plane = between(luminaire.horizontal, folded(about, luminaire.horizontal.back()));
  const auto along = [&](std::size_t which) {
    const double* values = &luminaire.candela[which * angles.size() + row.low];
    return row.share > 0.0 ? values[0] + row.share * (values[1] - values[0]) : values[0];
  };
  const double here = along(plane.low);
  return plane.share > 0.0 ? here + plane.share * (along(plane.low + 1) - here) : here;
}

double flux(const Photometry& luminaire) {
  const std::vector<double>& planes = luminaire.horizontal;
  if (planes.size() == 1) return 2.0 * M_PI * over_plane(luminaire, 0);
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < planes.size(); ++i) {
    sum += (planes[i + 1] - planes[i]) * (over_plane(luminaire, i) + over_plane(luminaire, i + 1)) /
           2.0;
  }
  return sum * 2.0 * M_PI / planes.back();
}

}  // namespace angen::light

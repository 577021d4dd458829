#include "sensors/pir/fresnel_lens.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace angen::sensors {

namespace {

constexpr double kSoft = 0.25;  // share of a zone's width or height that a lens blurs at each edge

/// 0 outside of 0 … 1, 1 in the middle, linear at the edges; half at 0 and 1.
double soft_box(double u) {
  const double inside = std::min(u, 1.0 - u);
  return std::clamp(inside / kSoft + 0.5, 0.0, 1.0);
}

template <class Use>
void for_each_lens_row(Use&& use) {
  std::istringstream lines(kLensTable);
  std::string line;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string name;
    FresnelLens::Row row;
    Window& w = row.window;
    if (!(words >> name) || name[0] == '#') continue;
    words >> row.pairs >> w.right >> w.left >> w.low >> w.high;
    for (double* angle : {&w.right, &w.left, &w.low, &w.high}) *angle *= M_PI / 180.0;
    use(name, row);
  }
}

}  // namespace

FresnelLens::FresnelLens(const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    Zones zones;
    zones.window = row.window;
    zones.width = (row.window.left - row.window.right) / row.pairs;
    for (int zone = 0; zone < 2 * row.pairs; ++zone) {
      zones.sign.push_back(zone % 2 == 0 ? 1.0 : -1.0);
    }
    const double soft_side = 0.25 * zones.width * kSoft;
    const double soft_end = (row.window.high - row.window.low) * kSoft;
    if (rows_.empty()) window_ = row.window;
    window_.right = std::min(window_.right, row.window.right - soft_side);
    window_.left = std::max(window_.left, row.window.left + soft_side);
    window_.low = std::min(window_.low, row.window.low - soft_end);
    window_.high = std::max(window_.high, row.window.high + soft_end);
    rows_.push_back(std::move(zones));
  }
}

void FresnelLens::tape(const Window& window) {
  for (Zones& row : rows_) {
    const double middle = 0.5 * (row.window.low + row.window.high);
    if (middle < window.low || middle > window.high) continue;
    for (std::size_t zone = 0; zone < row.sign.size(); ++zone) {
      const double azimuth = row.window.right + 0.5 * row.width * (static_cast<double>(zone) + 0.5);
      if (azimuth >= window.right && azimuth <= window.left) row.sign[zone] = 0.0;
    }
  }
}

void FresnelLens::find_line(double elevation, Line& line) const {
  line.parts_.clear();
  for (const Zones& row : rows_) {
    const double up = soft_box((elevation - row.window.low) / (row.window.high - row.window.low));
    if (up != 0.0) line.parts_.push_back({&row, up});
  }
}

double FresnelLens::Line::sensitivity(double azimuth) const {
  double sum = 0.0;
  for (const Part& part : parts_) {
    const Zones& row = *part.row;
    // Half a pair holds one zone, as wide as half of it, in its middle.
    const double half = (azimuth - row.window.right) / (0.5 * row.width);
    if (half < 0.0 || half >= static_cast<double>(row.sign.size())) continue;
    const auto zone = static_cast<std::size_t>(half);
    const double across = soft_box(2.0 * (half - static_cast<double>(zone)) - 0.5);
    sum += row.sign[zone] * across * part.up;
  }
  return sum;
}

std::vector<Vec3> FresnelLens::directions() const {
  std::vector<Vec3> all;
  for (const Zones& row : rows_) {
    const double height = row.window.high - row.window.low;
    for (std::size_t zone = 0; zone < row.sign.size(); ++zone) {
      if (row.sign[zone] == 0.0) continue;
      const double right = row.window.right + 0.5 * row.width * (static_cast<double>(zone) + 0.25);
      for (int i = 0; i < 9; ++i) {
        const double azimuth = right + 0.25 * row.width * (i % 3 + 0.5) / 3.0;
        const double elevation = row.window.low + height * (i / 3 + 0.5) / 3.0;
        all.emplace_back(std::cos(elevation) * std::cos(azimuth),
                         std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      }
    }
  }
  return all;
}

double FresnelLens::narrowest() const {
  double least = 2.0 * M_PI;
  for (const Zones& row : rows_) least = std::min(least, 0.25 * row.width);  // and gaps as wide
  return least;
}

double FresnelLens::lowest() const {
  double least = M_PI;
  for (const Zones& row : rows_) least = std::min(least, row.window.high - row.window.low);
  return least;
}

std::vector<std::string> lens_names() {
  std::vector<std::string> names;
  for_each_lens_row([&](const std::string& name, const FresnelLens::Row&) {
    if (names.empty() || names.back() != name) names.push_back(name);
  });
  return names;
}

std::vector<FresnelLens::Row> lens_rows(const std::string& name) {
  std::vector<FresnelLens::Row> rows;
  for_each_lens_row([&](const std::string& each, const FresnelLens::Row& row) {
    if (each == name) rows.push_back(row);
  });
  return rows;
}

}  // namespace angen::sensors

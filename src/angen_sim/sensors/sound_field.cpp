#include "sensors/sound_field.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace angen::sensors {

namespace {

constexpr double kSourceSize = 0.1;  // m: a source is not a point

}  // namespace

SoundField::SoundField(const std::vector<double>& surfaces, double absorption)
    : absorption_(absorption) {
  const auto count = static_cast<Eigen::Index>(surfaces.size());
  balance_ = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    balance_(i, i) = absorption * surfaces[static_cast<std::size_t>(i)];
  }
}

void SoundField::pass(int first, int second, double area) {
  for (const int room : {first, second}) {
    if (room != kOutside) balance_(room, room) += area;
  }
  if (first == kOutside || second == kOutside) return;
  balance_(first, second) -= area;
  balance_(second, first) -= area;
}

// After the first reflection 1 - absorption of a source's power is left and feeds the diffuse
// field. The balance is symmetric, so one solution serves for sources in all rooms.
std::vector<double> SoundField::gains(int room) const {
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(balance_.rows());
  unit(room) = 4.0 * (1.0 - absorption_);
  const Eigen::VectorXd solved = balance_.partialPivLu().solve(unit);
  return {solved.begin(), solved.end()};
}

double direct_gain(double distance, double directivity) {
  const double away = std::max(distance, kSourceSize);
  return directivity / (4.0 * M_PI * away * away);
}

double from_decibels(double level) { return std::pow(10.0, level / 10.0); }

double to_decibels(double ratio) { return 10.0 * std::log10(ratio); }

}  // namespace angen::sensors

#include "core/random.h"

#include <algorithm>
#include <cmath>

namespace angen {

namespace {

constexpr double kMax = 1.0 - 0x1.0p-53;  // less than 1, so that no radius is infinite

}  // namespace

// Box and Muller 1958; the second of each pair is kept.
double Rng::gaussian() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  const double angle = 2.0 * M_PI * uniform();
  spare_ = radius * std::sin(angle);
  has_spare_ = true;
  return radius * std::cos(angle);
}

// Box and Muller's pairs; a pair's radius r bounds both. 1 - exp(-r^2 / 2) is uniform in 0..1, and
// the greatest of n such is u^(1/n): it is drawn first, the others below it.
void Rng::gaussians(double* numbers, std::size_t count) {
  const std::size_t pairs = (count + 1) / 2;
  if (pairs == 0) return;
  const double greatest = std::pow(uniform(), 1.0 / static_cast<double>(pairs));
  const std::size_t outermost = next() % pairs;
  for (std::size_t pair = 0; pair < pairs; ++pair) {
    const double share = pair == outermost ? 1.0 : uniform();
    const double radius = std::sqrt(-2.0 * std::log(1.0 - std::min(share * greatest, kMax)));
    const double angle = 2.0 * M_PI * uniform();
    numbers[2 * pair] = radius * std::cos(angle);
    if (2 * pair + 1 < count) numbers[2 * pair + 1] = radius * std::sin(angle);
  }
}

double chance_within(std::size_t count, double limit) {
  const double one = -std::expm1(-0.5 * 0.998 * limit * limit);
  return std::pow(one, static_cast<double>((count + 1) / 2));
}

}  // namespace angen

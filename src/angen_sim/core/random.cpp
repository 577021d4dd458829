#include "core/random.h"

#include <cmath>

namespace angen {

namespace {

std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

}  // namespace

Rng::Rng(std::uint64_t seed, std::uint64_t name_hash, std::int64_t tick)
    : state_(mix(seed + 0x9e3779b97f4a7c15ULL) ^ mix(name_hash) ^
             mix(static_cast<std::uint64_t>(tick) * 0xd1342543de82ef95ULL + 1)) {}

std::uint64_t Rng::next() {
  state_ += 0x9e3779b97f4a7c15ULL;
  return mix(state_);
}

double Rng::uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

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

// A pair's radius bounds both; the margin is for the rounding of gaussian().
bool Rng::gaussians_within(std::size_t count, double limit) {
  const double least = std::exp(-0.5 * 0.998 * limit * limit);  // of 1 - uniform()
  for (std::size_t i = 0; i < count; i += 2) {
    if (1.0 - uniform() < least) return false;
    next();
  }
  return true;
}

}  // namespace angen

#include "plugin/noise.h"

#include <algorithm>
#include <cmath>

namespace angen {

namespace {

bool takes(const Noise& noise, double value) {
  return std::isfinite(value) && !(noise.relative && value == 0.0);
}

double noisy(const Noise& noise, double value, Rng& rng) {
  if (!takes(noise, value)) return value;
  const double error = noise.stddev > 0.0 ? noise.stddev * rng.gaussian() : 0.0;
  if (noise.relative) return value * std::max(0.0, 1.0 + noise.mean + error);
  return std::clamp(value + noise.mean + error, noise.range.min, noise.range.max);
}

}  // namespace

bool Noise::varies(const Reading& reading) const {
  if (stddev <= 0.0) return false;
  const Value* value = reading.find(field);
  if (value == nullptr) return false;
  if (const auto* number = std::get_if<double>(value)) return takes(*this, *number);
  const auto* list = std::get_if<std::vector<double>>(value);
  return list != nullptr &&
         std::any_of(list->begin(), list->end(), [&](double each) { return takes(*this, each); });
}

void Noise::apply(Rng& rng, Reading& reading) const {
  const Value* value = reading.find(field);
  if (value == nullptr) return;
  if (const auto* number = std::get_if<double>(value)) {
    reading.set(field.c_str(), noisy(*this, *number, rng));
  } else if (const auto* list = std::get_if<std::vector<double>>(value)) {
    std::vector<double> changed = *list;
    for (double& each : changed) each = noisy(*this, each, rng);
    reading.set(field.c_str(), std::move(changed));
  }
}

Reading with_noise(const std::vector<Noise>& noise, const Reading& clean, Rng rng) {
  Reading reading = clean;
  for (const Noise& each : noise) each.apply(rng, reading);
  return reading;
}

}  // namespace angen

#include "sensors/pir/band_pass.h"

#include <cmath>
#include <complex>

namespace angen::sensors {

double BandPass::Section::step(double input) {
  y = b0 * input + b1 * x + a * y;
  x = input;
  return y;
}

// First order, by the bilinear transform with its corner (Hz) where it should be.
BandPass::Section BandPass::low_pass(double corner, double period) {
  const double k = std::tan(M_PI * corner * period);
  Section section;
  section.b0 = section.b1 = k / (1.0 + k);
  section.a = (1.0 - k) / (1.0 + k);
  return section;
}

BandPass::Section BandPass::high_pass(double corner, double period) {
  Section section = low_pass(corner, period);
  section.b0 = 1.0 / (1.0 + std::tan(M_PI * corner * period));
  section.b1 = -section.b0;
  return section;
}

BandPass::BandPass(const Corners& corners, double responsivity, double period)
    : sections_{low_pass(0.5 / (M_PI * corners.thermal_time), period),
                high_pass(0.5 / (M_PI * corners.electrical_time), period),
                high_pass(corners.low, period), low_pass(corners.high, period)},
      scale_(1.0),
      period_(period) {
  scale_ = responsivity / gain(1.0);
}

double BandPass::step(double flux) {
  double value = scale_ * flux;
  for (Section& section : sections_) value = section.step(value);
  return value;
}

void BandPass::settle(double flux) {
  double value = scale_ * flux;
  for (Section& section : sections_) {
    section.x = value;
    value *= (section.b0 + section.b1) / (1.0 - section.a);
    section.y = value;
  }
}

bool BandPass::settled(double flux, double volts) const {
  BandPass rest = *this;
  rest.settle(flux);
  for (std::size_t i = 0; i < sections_.size(); ++i) {
    if (std::abs(sections_[i].x - rest.sections_[i].x) > volts) return false;
    if (std::abs(sections_[i].y - rest.sections_[i].y) > volts) return false;
  }
  return true;
}

double BandPass::gain(double frequency) const {
  const std::complex<double> delay = std::polar(1.0, -2.0 * M_PI * frequency * period_);
  std::complex<double> response = scale_;
  for (const Section& s : sections_) response *= (s.b0 + s.b1 * delay) / (1.0 - s.a * delay);
  return std::abs(response);
}

}  // namespace angen::sensors

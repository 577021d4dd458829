#pragma once

#include <array>

namespace angen::sensors {

/// A pyroelectric element and its amplifier: volts from the watts that fall on the element.
class BandPass {
 public:
  struct Corners {
    double thermal_time = 0.1;     // s: the element warms
    double electrical_time = 1.6;  // s: its charge leaks away
    double low = 0.4;              // Hz, of the amplifier
    double high = 10.0;
  };

  BandPass() = default;
  /// `responsivity` is the gain in V/W at 1 Hz, samples are `period` s apart.
  BandPass(const Corners& corners, double responsivity, double period);

  /// The voltage for the next sample's flux in W.
  double step(double flux);

  /// Settles as if this flux had always been there: 0 V.
  void settle(double flux);

  /// Whether nothing in it is further from that than `volts`.
  bool settled(double flux, double volts) const;

  /// |volts / watts| of a sine of `frequency` in Hz.
  double gain(double frequency) const;

 private:
  /// y = b0 x + b1 x' + a y', the primes the last sample's.
  struct Section {
    double b0 = 0.0;
    double b1 = 0.0;
    double a = 0.0;
    double x = 0.0;
    double y = 0.0;

    double step(double input);
  };

  static Section low_pass(double corner, double period);
  static Section high_pass(double corner, double period);

  std::array<Section, 4> sections_;
  double scale_ = 0.0;
  double period_ = 0.01;
};

}  // namespace angen::sensors

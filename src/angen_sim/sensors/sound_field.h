#pragma once

#include <Eigen/Core>
#include <vector>

namespace angen::sensors {

/// The diffuse fields of rooms that sound passes between, in balance: sound on a room's
/// surfaces is absorbed or passes into the next room (H. Kuttruff, Room Acoustics, coupled rooms).
/// Sound that leaves into the open does not come back.
class SoundField {
 public:
  static constexpr int kOutside = -1;

  /// Areas in m^2 of the surfaces of the rooms; `absorption` is their mean coefficient, below 1.
  SoundField(const std::vector<double>& surfaces, double absorption);

  /// `area` (m^2) times the share of the sound that it lets through; the rooms may be kOutside.
  void pass(int first, int second, double area);

  /// Mean square pressure of the diffuse field in `room` for each watt of a source in each room, as
  /// the power (W) whose level over 1 pW is the sound pressure level: 4/R in a room by itself.
  std::vector<double> gains(int room) const;

 private:
  double absorption_;
  Eigen::MatrixXd balance_;  // m^2
};

/// Gain of the direct sound at a distance (m) of a source of some directivity: Q / (4 pi r^2).
double direct_gain(double distance, double directivity);

/// 10^(dB/10), and back.
double from_decibels(double level);
double to_decibels(double ratio);

}  // namespace angen::sensors

#pragma once

#include <limits>
#include <vector>

#include "plugin/plugin.h"

namespace angen::devices {

/// The sound of a device, which microphones hear: its parameters, and its fields.
class Sound {
 public:
  static constexpr double kSilent = -std::numeric_limits<double>::infinity();  // dB

  /// `level` (dB over 1 pW) is the default.
  void configure(Params& params, double level, const char* level_doc);
  /// dB over 1 pW.
  double level() const { return level_; }

  /// The fields of a device whose sound has that level now.
  void report(double level, Reading& state) const;

  /// Adds the fields to a kind.
  static Kind describe(Kind kind);

 private:
  double level_ = 0.0;
  double directivity_ = 1.0;
  std::vector<double> position_{0.0, 0.0, 0.0};
};

}  // namespace angen::devices

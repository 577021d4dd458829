#pragma once

#include <string>
#include <vector>

#include "core/pose.h"
#include "core/time.h"

namespace angen::sim {

/// A fault of a sensor, or of the transmission of its readings. Times count from when the fault
/// was given.
struct Fault {
  enum class Kind {
    kDropout,
    kStuck,
    kFalseAlarm,
    kDelay,
    kDuplicate,
    kClock,
    kBattery,
    kMoved,
  };

  Kind kind = Kind::kDropout;
  double share = 0.0;  // share of its messages
  double a_day = 0.0;  // false alarms, or seconds that its clock gains
  Nanoseconds from = 0;
  Nanoseconds lasts = 0;
  Nanoseconds least = 0;  // least delay
  Nanoseconds most = 0;
  Pose by;  // displacement in its own frame

  const char* name() const;
};

/// Faults of a text: "dropout share=0.02; delay by=6-120", times in s. Throws Error, which says
/// what would be right.
std::vector<Fault> parse_faults(const std::string& text);

}  // namespace angen::sim

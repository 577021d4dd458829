#pragma once

#include <string>
#include <vector>

#include "plugin/reading.h"

namespace angen::sensors {

/// The ids that a reader has reported, and the events when they change.
class IdChanges {
 public:
  IdChanges(const char* added, const char* removed) : added_(added), removed_(removed) {}

  /// One event per sample: new ids, or if there are none, removed ids. `ids` are sorted.
  void note(const std::vector<std::string>& ids, Reading& reading);
  /// Whether ids were removed by the sample that had new ones: the next sample reports them.
  bool pending() const { return pending_; }

 private:
  const char* added_;
  const char* removed_;
  std::vector<std::string> last_;  // last reported
  bool pending_ = false;
};

}  // namespace angen::sensors

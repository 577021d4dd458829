#pragma once

#include <string>
#include <vector>

#include "plugin/reading.h"

namespace angen::sensors {

/// Which ids a reader had in its last sample, and the events when they change.
class IdChanges {
 public:
  IdChanges(const char* came, const char* gone) : came_(came), gone_(gone) {}

  /// One event per sample: new ids, or if there are none, removed ids. `ids` are sorted.
  void note(const std::vector<std::string>& ids, Reading& reading);

 private:
  const char* came_;
  const char* gone_;
  std::vector<std::string> last_;
};

}  // namespace angen::sensors

#include "sensors/id_changes.h"

#include <algorithm>
#include <iterator>

#include "core/diagnostics.h"

namespace angen::sensors {

void IdChanges::note(const std::vector<std::string>& ids, Reading& reading) {
  std::vector<std::string> came;
  std::vector<std::string> gone;
  std::set_difference(ids.begin(), ids.end(), last_.begin(), last_.end(), std::back_inserter(came));
  std::set_difference(last_.begin(), last_.end(), ids.begin(), ids.end(), std::back_inserter(gone));
  pending_ = !came.empty() && !gone.empty();
  if (pending_) {
    last_.insert(last_.end(), came.begin(), came.end());
    std::sort(last_.begin(), last_.end());
  } else {
    last_ = ids;
  }
  if (came.empty() && gone.empty()) return;
  reading.event = came.empty() ? gone_ : came_;
  reading.event_detail = join_names(came.empty() ? gone : came);
}

}  // namespace angen::sensors

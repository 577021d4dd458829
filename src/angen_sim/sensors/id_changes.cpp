#include "sensors/id_changes.h"

#include <algorithm>
#include <iterator>

#include "core/diagnostics.h"

namespace angen::sensors {

void IdChanges::note(const std::vector<std::string>& ids, Reading& reading) {
  std::vector<std::string> added;
  std::vector<std::string> removed;
  std::set_difference(ids.begin(), ids.end(), last_.begin(), last_.end(),
                      std::back_inserter(added));
  std::set_difference(last_.begin(), last_.end(), ids.begin(), ids.end(),
                      std::back_inserter(removed));
  pending_ = !added.empty() && !removed.empty();
  if (pending_) {
    last_.insert(last_.end(), added.begin(), added.end());
    std::sort(last_.begin(), last_.end());
  } else {
    last_ = ids;
  }
  if (added.empty() && removed.empty()) return;
  reading.event = added.empty() ? removed_ : added_;
  reading.event_detail = join_names(added.empty() ? removed : added);
}

}  // namespace angen::sensors

#include "light/receiver.h"

#include <algorithm>

namespace angen::light {

Receiver::Known& Receiver::of(LampId lamp) {
  if (known.size() <= lamp.index) known.resize(lamp.index + 1);
  Known& found = known[lamp.index];
  if (found.lamp != lamp) {
    found = {};
    found.lamp = lamp;
  }
  return found;
}

const Receiver::Known* Receiver::find(LampId lamp) const {
  if (known.size() <= lamp.index || known[lamp.index].lamp != lamp) return nullptr;
  return known[lamp.index].found ? &known[lamp.index] : nullptr;
}

void Receiver::note(std::uint64_t revision, bool still, const Eigen::AlignedBox3d& box) {
  for (Known& each : known) {
    if (each.scene == revision || each.scene == kNever) continue;
    each.scene = still && box.contains(each.transport.reach) ? revision : kNever;
  }
  if (gather && still) gather->hold_movers(box);
}

void Receiver::drop() {
  gather = nullptr;
  for (Known& each : known) each.scene = kNever;
}

bool Receiver::intersects(const Eigen::AlignedBox3d& box) const {
  if (gather && gather->may_see(box)) return true;
  return std::any_of(known.begin(), known.end(), [&](const Known& each) {
    return each.found && each.transport.reach.intersects(box);
  });
}

}  // namespace angen::light

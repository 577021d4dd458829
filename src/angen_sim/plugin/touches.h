#pragma once

#include <vector>

#include "core/contact.h"
#include "core/time.h"
#include "plugin/parts.h"

namespace angen {

class View;

/// What touches some collisions of a sensor now, or did since its last reading.
class Touches {
 public:
  /// Touches that ended earlier than this time (ns) ago are left out.
  void watch(std::vector<ContactRef> collisions, Nanoseconds window);
  bool any() const { return !collisions_.empty(); }

  /// The pairs, each once, also if both of its collisions are watched.
  std::vector<ContactPair> pairs(const View& view);
  /// Whether all of the last pairs touch still.
  bool lasting() const { return lasting_; }

 private:
  std::vector<ContactRef> collisions_;
  Nanoseconds window_ = 0;
  bool lasting_ = true;
};

}  // namespace angen

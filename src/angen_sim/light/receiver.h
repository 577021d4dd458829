#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "light/gather.h"

namespace angen::light {

/// A place of measurement: what it sees, and the light of each lamp that comes to it, as far as
/// that is known.
struct Receiver {
  static constexpr std::uint64_t kNever = UINT64_MAX;

  struct Known {
    LampId lamp;
    Transport transport;  // the newest complete one; nothing before the first
    bool found = false;
    bool queued = false;           // to be found by Lighting::advance
    std::uint64_t key = 0;         // of what it was found from
    std::uint64_t scene = kNever;  // the revision for which it holds

    bool holds(std::uint64_t now_key, std::uint64_t revision) const {
      return found && key == now_key && scene == revision;
    }
  };

  explicit Receiver(const Pose& at) : pose(at) {}

  Known& of(LampId lamp);
  /// What is known of it, or nothing.
  const Known* find(LampId lamp) const;

  /// What was known holds in a scene of that revision where `still` says that nothing has moved in
  /// the box.
  void note(std::uint64_t revision, bool still, const Eigen::AlignedBox3d& box);

  /// Forgets what stands around it; what came from lamps serves until it is found anew.
  void drop();
  /// Whether a change of static shapes in the box is one of what is known.
  bool meets(const Eigen::AlignedBox3d& box) const;

  Pose pose;
  bool ahead = false;    // see Probe
  bool begun = false;    // its light has been queried, or will be
  bool counted = false;  // for its gather, by Lighting::advance
  std::unique_ptr<Gather> gather;
  std::vector<Known> known;  // by the lamp's index
};

}  // namespace angen::light

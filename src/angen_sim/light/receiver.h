#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "light/gather.h"

namespace angen::light {

/// Cache of a place of measurement: the surfaces around it, and the light of each lamp.
struct Receiver {
  static constexpr std::uint64_t kNever = UINT64_MAX;

  struct Known {
    LampId lamp;
    Transport transport;  // the newest complete one, if `found`
    bool found = false;
    bool queued = false;           // to be computed by Lighting::advance
    std::uint64_t key = 0;         // key of its inputs
    std::uint64_t scene = kNever;  // the scene's revision for which it is valid

    bool holds(std::uint64_t now_key, std::uint64_t revision) const {
      return found && key == now_key && scene == revision;
    }
  };

  explicit Receiver(const Pose& at) : pose(at) {}

  Known& of(LampId lamp);
  /// The known light of the lamp, or null.
  const Known* find(LampId lamp) const;

  /// Keeps known light valid for that revision of the scene if its reach is in the box, where
  /// nothing has moved according to `still`.
  void note(std::uint64_t revision, bool still, const Eigen::AlignedBox3d& box);

  /// Forgets the surfaces around it; known light is used until it is computed again.
  void drop();
  /// Whether a change of static shapes in the box (m, world) affects it.
  bool intersects(const Eigen::AlignedBox3d& box) const;

  Pose pose;
  bool ahead = false;    // see Probe
  bool begun = false;    // its light has been queried, or will be
  bool counted = false;  // the cost of its gather, by Lighting::advance
  std::unique_ptr<Gather> gather;
  std::vector<Known> known;  // by the lamp's index
};

}  // namespace angen::light

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
    Transport transport;  // the newest one, if `found`
    bool found = false;
    std::uint64_t stamp = 0;       // stamp of its solution
    std::uint64_t geometry = 0;    // geometry of its source
    std::uint64_t scene = kNever;  // the scene's revision for which it is valid

    bool holds(const Source& source, std::uint64_t revision) const {
      return found && stamp == source.solution.stamp && geometry == source.geometry &&
             scene == revision;
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
  std::unique_ptr<Gather> gather;
  std::vector<Known> known;  // by the lamp's index
};

}  // namespace angen::light

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/element.h"
#include "sim/snapshot.h"

namespace angen::sim {

/// A model's <plugin> with the parameters that its devices have now.
struct SavedPlugin {
  std::string model;
  Element plugin;
};

/// What a world's file can say of one moment.
struct SavedState {
  std::shared_ptr<const Snapshot> snapshot;
  std::vector<SavedPlugin> plugins;  // of devices that differ from how they started
};

}  // namespace angen::sim

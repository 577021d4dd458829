#pragma once

#include <cstdint>
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

/// A model with inertials, joints or lights that were changed.
struct ChangedModel {
  std::uint32_t model = 0;                  // in Structure::models
  std::shared_ptr<const desc::Model> read;  // the model as it was loaded
};

/// A light that the world's text does not have, or whose own lamp differs from how it started.
struct SavedLight {
  std::uint32_t light = 0;  // in Structure::lights
  std::string sdf;          // the text that it was spawned from
  Element lamp;             // its parameters as children
};

/// The state of a world at one moment, as a world file can have it.
struct SavedState {
  std::shared_ptr<const Snapshot> snapshot;
  std::vector<SavedPlugin> plugins;  // plug-ins of devices that differ from how they started
  std::vector<ChangedModel> changed;
  std::vector<SavedLight> lights;
};

}  // namespace angen::sim

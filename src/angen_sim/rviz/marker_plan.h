#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rviz/marker_shapes.h"
#include "sim/gait.h"
#include "sim/snapshot.h"

namespace angen::node {

/// The namespace of a link's markers, which rviz can switch off: `doors 0`, `walls south 1`,
/// `furniture 0`, `robots`, … with the storey that its description places the model on.
std::string marker_group(const sim::Structure& structure, std::uint32_t link);

/// A marker, and the limb of a person that it is a part of.
struct LinkDrawing : Drawing {
  int limb = sim::kNoLimb;
};

/// Markers of one link.
struct DrawnLink {
  std::vector<LinkDrawing> drawings;
  bool walks = false;  // it is a person
  sim::Gait gait;
  Pose at;  // at the last publication, and its time
  Nanoseconds time = -1;
};

/// Markers of one model, with the groups and ids that they keep until the model is deleted.
struct DrawnModel {
  std::vector<DrawnLink> links;  // as desc::Model::links
};

/// Numbers them from `next_id` on. `first_link` is the model's first in Structure::links.
DrawnModel draw_model(const sim::Structure& structure, std::uint32_t first_link,
                      std::int32_t& next_id);

}  // namespace angen::node

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rviz/marker_shapes.h"
#include "sim/snapshot.h"

namespace angen::node {

/// A marker, and the limb that it is a part of, in Anatomy::limbs; -1: none.
struct LinkDrawing : Drawing {
  int limb = -1;
};

/// Markers of one link.
struct DrawnLink {
  std::vector<LinkDrawing> drawings;
  sim::LimbPoses limbs;
};

/// Markers of one model, with the groups (their namespaces) and ids that they keep until the model
/// is deleted.
struct DrawnModel {
  std::vector<DrawnLink> links;  // indexed like desc::Model::links
};

/// Numbers them from `next_id` on. `first_link` is the model's first in Structure::links.
DrawnModel draw_model(const sim::Structure& structure, std::uint32_t first_link,
                      std::int32_t& next_id);

}  // namespace angen::node

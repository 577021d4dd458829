#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rviz/marker_shapes.h"
#include "sim/snapshot.h"

namespace angen::node {

/// The namespace of a link's markers, which rviz can switch off: `doors 0`, `walls south 1`,
/// `furniture 0`, `robots`, … with the storey that its description places the model on.
std::string marker_group(const sim::Structure& structure, std::uint32_t link);

/// Markers of one model, with the groups and ids that they keep until the model is deleted.
struct DrawnModel {
  std::vector<std::vector<Drawing>> links;  // as desc::Model::links
};

/// Numbers them from `next_id` on. `first_link` is the model's first in Structure::links.
DrawnModel draw_model(const sim::Structure& structure, std::uint32_t first_link,
                      std::int32_t& next_id);

}  // namespace angen::node

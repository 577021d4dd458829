#include "node/rescue.h"

#include <ros/this_node.h>

#include <algorithm>

#include "core/diagnostics.h"
#include "core/private_file.h"
#include "record/world_file.h"

namespace angen::node {

std::string default_rescue_path() {
  std::string space = ros::this_node::getNamespace();
  std::replace(space.begin(), space.end(), '/', '_');
  return state_folder() + "/rescue" + (space == "_" ? "" : space) + ".world";
}

void rescue(sim::Simulation& simulation, const std::string& path) {
  const std::string text = record::world_file(simulation.world(), simulation.saved());
  try {
    if (path == default_rescue_path()) make_private_folder(state_folder());
    write_private_file(path, text);
  } catch (const Error& error) {
    throw Error(std::string("the world cannot be saved in ") + error.what());
  }
}

}  // namespace angen::node

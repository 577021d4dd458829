#include "plugin/plugin.h"

namespace angen {

Verdict Device::command(const Command&, const View&) {
  return Verdict::reject("it takes no commands");
}

const ModelInfo::Joint* ModelInfo::joint(const std::string& joint_name) const {
  for (const Joint& j : joints) {
    if (j.name == joint_name) return &j;
  }
  return nullptr;
}

bool Plugin::makes_sensors() const {
  Params nothing{Element{}};
  return make_sensor(nothing) != nullptr;
}

std::vector<Mount> Plugin::mounts(const ModelInfo& model, Params&) const {
  if (!serves(model)) return {};
  return {{instance_name(model), ""}};
}

}  // namespace angen

#include "plugin/plugin.h"

#include "core/named.h"

namespace angen {

Verdict Device::command(const Command&, const View&) {
  return Verdict::reject("it takes no commands");
}

const ModelInfo::Joint* ModelInfo::joint(const std::string& joint_name) const {
  const auto index = index_in(joints, joint_name);
  return index ? &joints[*index] : nullptr;
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

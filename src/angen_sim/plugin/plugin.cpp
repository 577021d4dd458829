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

}  // namespace angen

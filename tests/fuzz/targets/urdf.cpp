#include "fuzz/targets.h"
#include "sdf/load.h"

namespace angen::fuzz {

// SDF models as well: what /angen/spawn takes.
void urdf(const std::string& input) {
  answered([&] {
    const desc::Model model = load::model(input, "fuzzed", {}, {});
    require(model.name == "fuzzed", "a model has the name that it was to have");
  });
}

}  // namespace angen::fuzz

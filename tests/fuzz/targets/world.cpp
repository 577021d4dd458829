#include "fuzz/targets.h"
#include "sdf/load.h"

namespace angen::fuzz {

void world(const std::string& input) {
  answered([&] {
    const desc::World read = load::world_from_text(input, "fuzz.world", {});
    std::vector<load::ModelState> models;
    for (const desc::Model& model : read.models) {
      models.push_back({&model, model.pose, {}, {}, {}});
    }
    const std::string saved = load::save(read, models);
    std::size_t again = SIZE_MAX;
    answered([&] { again = load::world_from_text(saved, "saved.world", {}).models.size(); });
    require(again == models.size(), "a world that was read and saved loads again");
  });
}

}  // namespace angen::fuzz

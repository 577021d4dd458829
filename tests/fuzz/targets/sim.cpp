#include "fuzz/targets.h"
#include "sdf/load.h"
#include "sim/simulation.h"

namespace angen::fuzz {

// A world that loads runs, or building it throws an error.
void sim(const std::string& input) {
  static const auto catalog = std::make_shared<Catalog>();
  answered([&] {
    angen::sim::Simulation simulation(load::world_from_text(input, "fuzz.world", {}), 1, catalog);
    for (int tick = 0; tick < 20; ++tick) simulation.tick();
    simulation.leap(simulation.snapshot()->time + kSecond / 10);
  });
}

}  // namespace angen::fuzz

#include "ros/readings.h"

#include <gtest/gtest.h>

#include "angen_sim/sim/household.h"

namespace angen::node {
namespace {

TEST(Readings, AreThoseOfTheSnapshotAndAreMadeOnce) {
  sim::Simulation simulation(load::world_from_text(sim::text_of_world(), "text", {}), 3,
                             std::make_shared<Catalog>());
  Readings readings;
  int lazy = 0;
  for (int tick = 0; tick < 6000; ++tick) {
    if (tick == 3000) simulation.post(sim::Delete{"ball"});
    const auto snapshot = simulation.tick();
    if (tick % 50 != 0) continue;
    for (std::uint32_t i = 0; i < snapshot->sensors.size(); ++i) {
      if (snapshot->sensors[i].reading == nullptr) continue;
      const auto made = readings.of(*snapshot, i);
      const auto expected = snapshot->reading(i);
      EXPECT_EQ(made->stamp, expected->stamp);
      EXPECT_TRUE(made->same_values(*expected));
      EXPECT_EQ(readings.of(*snapshot, i), made);
      lazy += snapshot->sensors[i].lazy != nullptr ? 1 : 0;
    }
  }
  EXPECT_GT(lazy, 0);
}

}  // namespace
}  // namespace angen::node

#include "record/fingerprint.h"

#include "angen_sim/sim/household.h"

namespace angen::record {
namespace {

std::string run(std::uint64_t seed, const std::string& lamp_command = "", int ticks = 600) {
  sim::Simulation simulation(load::world_from_text(sim::text_of_household(), "home", {}), seed,
                             std::make_shared<Catalog>());
  Fingerprint fingerprint;
  fingerprint.add(*simulation.snapshot());
  if (!lamp_command.empty()) simulation.post(sim::ToDevice{"lamp", "hall0", {lamp_command, {}}});
  for (int i = 0; i < ticks; ++i) fingerprint.add(*simulation.tick());
  return fingerprint.text();
}

TEST(Fingerprint, IsThatOfTheRun) {
  const std::string one = run(1);
  EXPECT_EQ(one.size(), 16U);
  EXPECT_EQ(one.find_first_not_of("0123456789abcdef"), std::string::npos) << one;
  EXPECT_EQ(run(1), one);
  EXPECT_NE(run(2), one) << "of another seed";
  EXPECT_NE(run(1, "On"), one) << "of other commands";
  EXPECT_NE(run(1, "Dim 40"), run(1, "Dim 41"));
  EXPECT_NE(run(1, "", 599), one) << "of another length";
}

// One field of a snapshot after the other.
TEST(Fingerprint, ChangesWithAllThatASnapshotSays) {
  sim::Simulation simulation(load::world_from_text(sim::text_of_household(), "home", {}), 1,
                             std::make_shared<Catalog>());
  for (int i = 0; i < 1100; ++i) simulation.tick();
  sim::Snapshot base = *simulation.snapshot();
  base.events.clear();
  base.moved_links.clear();
  base.new_readings.clear();
  base.new_states.clear();
  const auto print_of = [](const sim::Snapshot& snapshot) {
    Fingerprint fingerprint;
    fingerprint.add(snapshot);
    return fingerprint.value();
  };
  const auto expect_other = [&](const char* what,
                                const std::function<void(sim::Snapshot&)>& change) {
    sim::Snapshot changed = base;
    change(changed);
    EXPECT_NE(print_of(changed), print_of(base)) << what;
  };
  EXPECT_EQ(print_of(base), print_of(base));
  expect_other("tick", [](sim::Snapshot& s) { ++s.tick; });
  expect_other("time", [](sim::Snapshot& s) { ++s.time; });
  expect_other("paused", [](sim::Snapshot& s) { s.paused = !s.paused; });
  expect_other("link pose", [](sim::Snapshot& s) {
    Pose pose = s.link_poses[0];
    pose.position.x() += 1e-15;
    pose.position.y() = 7.0;
    s.link_poses.set(0, pose);
  });
  expect_other("joint", [](sim::Snapshot& s) { s.joint_positions.set(0, 0.25); });
  expect_other("moved link", [](sim::Snapshot& s) { s.moved_links = {1}; });
  expect_other("light", [](sim::Snapshot& s) {
    s.light_levels = std::make_shared<const std::vector<double>>(s.light_levels->size(), 0.5);
  });
  expect_other("state", [](sim::Snapshot& s) { s.new_states = {0}; });
  expect_other("event", [](sim::Snapshot& s) { s.events = {{0, "a", "b", "c", "d"}}; });
  const auto reading = std::make_shared<Reading>();
  reading->kind = "pir";
  reading->stamp = base.time;
  reading->set("motion", true);
  expect_other("reading", [&](sim::Snapshot& s) {
    s.sensors.set(0, {reading, nullptr});
    s.new_readings = {0};
  });
}

}  // namespace
}  // namespace angen::record

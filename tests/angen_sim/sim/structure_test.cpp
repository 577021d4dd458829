// Structures share parts that kept their numbers: each must equal one that is built from nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <random>

#include "angen_sim/sim/household.h"
#include "sdf/load.h"
#include "sim/simulation.h"

namespace angen::sim {
namespace {

/// Spawns and deletions at random in a household, by one command a tick.
class ChangingWorld {
 public:
  explicit ChangingWorld(unsigned seed)
      : random_(seed),
        simulation_(load::world_from_text(text_of_household(), "test", {}), 0,
                    std::make_shared<Catalog>()) {
    simulation_.tick();
  }

  std::shared_ptr<const Snapshot> change() {
    const std::vector<std::function<Action()>> sorts = {[&] { return spawn(); },
                                                        [&] { return spawn(); },
                                                        [&] { return erase(); },
                                                        [&] { return erase(); },
                                                        [&] { return attach(); },
                                                        [&] { return detach(); },
                                                        [&] { return add_light(); },
                                                        [&] { return erase_light(); },
                                                        [&] { return set_light(); },
                                                        [&] { return redescribe(); },
                                                        [&] { return Action(Reset{false}); }};
    const std::size_t sort = below(sorts.size() * 4);  // resets are rare
    simulation_.post(sorts[std::min(sort % sorts.size(), sort / 4)]());
    return simulation_.tick();
  }

  const Simulation& simulation() const { return simulation_; }

 private:
  std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }
  std::string new_name() { return "n" + std::to_string(count_++); }
  const Structure& now() const { return *simulation_.snapshot()->structure; }

  Action spawn() {
    desc::Model model = simulation_.world().models[below(simulation_.world().models.size())];
    model.name = new_name();
    for (desc::Link& link : model.links) {
      for (desc::Sensor& sensor : link.sensors) sensor.name = new_name();
    }
    return Spawn{model};
  }
  Action erase() {
    if (now().models.empty()) return spawn();
    return Delete{now().models[below(now().models.size())]->name};
  }
  Action attach() {
    desc::Sensor sensor = *simulation_.snapshot()->structure->sensors[0].desc;
    sensor.name = new_name();
    return Attach{sensor, now().links[below(now().links.size())].name};
  }
  Action detach() {
    for (const SensorEntry& sensor : now().sensors) {
      if (sensor.attached) return Delete{sensor.name};
    }
    return attach();
  }
  Action add_light() {
    desc::Light light;
    light.name = new_name();
    light.pose.position.z() = 2.0;
    return Edit(AddLight{light, ""});
  }
  Action erase_light() {
    if (now().lights.empty()) return add_light();
    return Edit(DeleteLight{now().lights[below(now().lights.size())].name});
  }
  Action set_light() {
    if (now().lights.empty()) return add_light();
    SetLight light;
    light.light = now().lights[below(now().lights.size())].name;
    light.pose.position.z() = 1.5;
    return Edit(light);
  }
  Action redescribe() {
    SetLinkProperties properties;
    properties.link = now().links[below(now().links.size())].name;
    properties.inertial.mass = 3.0;
    return Edit(properties);
  }

  std::mt19937 random_;
  int count_ = 0;
  Simulation simulation_;
};

// The list as it follows from the models alone: `parts` counts them in a model.
template <class Entry, class Count>
void expect_numbered(const SharedArray<Entry>& entries, const Structure& all, std::size_t at,
                     const Count& count) {
  for (std::uint32_t m = 0; m < all.models.size(); ++m) {
    for (std::size_t i = 0; i < count(m); ++i, ++at) {
      ASSERT_LT(at, entries.size());
      EXPECT_EQ(entries[at].model, m);
    }
  }
  EXPECT_EQ(at, entries.size());
}

void expect_whole(const Simulation& simulation, const Snapshot& snapshot) {
  const Structure& all = *snapshot.structure;
  const auto model = [&](std::uint32_t m) -> const desc::Model& { return *all.models[m]; };
  expect_numbered(all.links, all, 0, [&](std::uint32_t m) { return model(m).links.size(); });
  expect_numbered(all.joints, all, 0, [&](std::uint32_t m) { return model(m).joints.size(); });
  std::size_t own = 0;
  while (own < all.lights.size() && all.lights[own].model == UINT32_MAX) ++own;
  expect_numbered(all.lights, all, own, [&](std::uint32_t m) {
    std::size_t lights = 0;
    for (const desc::Link& link : model(m).links) lights += link.lights.size();
    return lights;
  });
  ASSERT_EQ(snapshot.link_poses.size(), all.links.size());
  ASSERT_EQ(snapshot.joint_positions.size(), all.joints.size());
  ASSERT_EQ(snapshot.devices.size(), all.devices.size());
  ASSERT_EQ(snapshot.sensors.size(), all.sensors.size());
  ASSERT_EQ(snapshot.light_levels->size(), all.lights.size());
  for (std::uint32_t i = 0; i < all.links.size(); ++i) {
    const LinkEntry& link = all.links[i];
    EXPECT_EQ(link.name, model(link.model).name + "::" + model(link.model).links[link.link].name);
    const Pose there = simulation.motion(i).pose;
    EXPECT_TRUE(snapshot.link_poses[i].position.isApprox(there.position, 1e-12)) << link.name;
    EXPECT_TRUE(snapshot.link_poses[i].rotation.isApprox(there.rotation, 1e-12)) << link.name;
  }
  for (const LightEntry& light : all.lights) {
    if (light.link == UINT32_MAX) continue;
    EXPECT_EQ(all.links[light.link].model, light.model) << light.name;
  }
  for (const SensorEntry& sensor : all.sensors) {
    EXPECT_EQ(all.links[sensor.link].model, sensor.model) << sensor.name;
  }
}

template <class Entries>
std::map<std::string, std::size_t> numbers_of(const Entries& entries) {
  std::map<std::string, std::size_t> numbers;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    numbers[entries[i].kind + "/" + entries[i].name] = i;
  }
  return numbers;
}

// The last report of a device that remains is still there, unless it has reported since.
void expect_kept(const Snapshot& before, const Snapshot& now) {
  const auto then = numbers_of(before.structure->devices);
  for (const auto& [name, i] : numbers_of(now.structure->devices)) {
    const auto at = then.find(name);
    const auto& news = now.new_states;
    if (at == then.end() || std::count(news.begin(), news.end(), i) != 0) continue;
    EXPECT_EQ(now.devices[i], before.devices[at->second]) << name;
  }
  const auto sensors = numbers_of(before.structure->sensors);
  for (const auto& [name, i] : numbers_of(now.structure->sensors)) {
    const auto at = sensors.find(name);
    if (at == sensors.end() || before.reading(at->second) == nullptr) continue;
    EXPECT_NE(now.reading(i), nullptr) << name;
  }
}

TEST(Structure, IsAsOneMadeAnewAfterEachChange) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    ChangingWorld world(seed);
    std::shared_ptr<const Snapshot> before = world.simulation().snapshot();
    int changes = 0;
    for (int i = 0; i < 150; ++i) {
      const std::shared_ptr<const Snapshot> now = world.change();
      const bool reset = now->events.size() == 1 && now->events[0].event == "reset";
      if (now->structure != before->structure) ++changes;
      expect_whole(world.simulation(), *now);
      if (!reset) expect_kept(*before, *now);
      ASSERT_FALSE(HasFailure()) << "seed " << seed << ", change " << i;
      before = now;
    }
    EXPECT_GT(changes, 60) << "most are carried out";
  }
}

TEST(Structure, OfWhatIsSpawnedBehindAResetStartsAtTimeZero) {
  Simulation simulation(load::world_from_text(text_of_household(), "test", {}), 0,
                        std::make_shared<Catalog>());
  for (int i = 0; i < 5; ++i) simulation.tick();
  desc::Sensor sensor = *simulation.snapshot()->structure->sensors[0].desc;
  sensor.name = "late";
  simulation.post(Reset{true});
  simulation.post(Attach{sensor, simulation.snapshot()->structure->links[0].name});
  const std::shared_ptr<const Snapshot> now = simulation.tick();
  ASSERT_EQ(now->tick, 1);
  bool found = false;
  for (const SensorEntry& entry : now->structure->sensors) {
    found = found || entry.name == "late";
    EXPECT_EQ(entry.schedule.start, 0) << entry.name;
  }
  EXPECT_TRUE(found);
  while (simulation.tick()->tick < 10) continue;
}

TEST(Structure, SharesWhatIsBeforeAChange) {
  Simulation simulation(load::world_from_text(text_of_household(), "test", {}), 0,
                        std::make_shared<Catalog>());
  desc::Model model;
  model.links.emplace_back();
  model.links[0].name = "link";
  for (int i = 0; i < 70; ++i) {
    model.name = "n" + std::to_string(i);
    simulation.post(Spawn{model});
  }
  const std::shared_ptr<const Snapshot> before = simulation.tick();
  model.name = "last";
  simulation.post(Spawn{model});
  const std::shared_ptr<const Snapshot> now = simulation.tick();
  ASSERT_EQ(now->structure->links.size(), before->structure->links.size() + 1);
  EXPECT_EQ(&now->structure->links[0], &before->structure->links[0]);
  EXPECT_EQ(now->structure->links.back().name, "last::link");
}

}  // namespace
}  // namespace angen::sim

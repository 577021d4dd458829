#include "ros/changes.h"

#include <gtest/gtest.h>

namespace angen::node {
namespace {

using List = std::vector<std::uint32_t>;
constexpr std::uint32_t kNew = Numbers::kNone;
constexpr std::uint32_t kGone = Numbers::kNone;

/// Models of two links, the second with a light; each with a device and a sensor.
class World {
 public:
  sim::Structure structure() const {
    sim::Structure made;
    for (const desc::Light& light : own_) made.lights.push_back({light.name, kNew, kNew, light});
    for (const auto& model : models_) {
      const auto m = static_cast<std::uint32_t>(made.models.size());
      made.models.push_back(model);
      for (std::uint32_t l = 0; l < 2; ++l) made.links.push_back({"", m, l, true});
      const auto link = static_cast<std::uint32_t>(made.links.size() - 1);
      made.lights.push_back({"", m, link, {}});
      made.devices.push_back({{}, m});
      sim::SensorEntry sensor;
      sensor.model = m;
      sensor.link = link;
      sensor.desc = {model, &model->links[1].sensors.front()};
      made.sensors.push_back(sensor);
    }
    return made;
  }
  void spawn() {
    desc::Model model;
    model.links.resize(2);
    model.links[1].sensors.resize(1);
    models_.push_back(std::make_shared<const desc::Model>(std::move(model)));
  }
  void erase(std::size_t model) { models_.erase(models_.begin() + static_cast<long>(model)); }
  void redescribe(std::size_t model) {
    models_[model] = std::make_shared<const desc::Model>(*models_[model]);
  }
  desc::Light& own_light(const std::string& name) {
    own_.emplace_back();
    own_.back().name = name;
    return own_.back();
  }
  std::vector<desc::Light>& own_lights() { return own_; }

 private:
  std::vector<std::shared_ptr<const desc::Model>> models_;
  std::vector<desc::Light> own_;
};

World three() {
  World world;
  for (int i = 0; i < 3; ++i) world.spawn();
  return world;
}

TEST(Changes, AtFirstEverythingIsNew) {
  const Changes changes = changes_between(nullptr, three().structure());
  EXPECT_EQ(changes.models.before, (List{kNew, kNew, kNew}));
  EXPECT_EQ(changes.links.before, List(6, kNew));
  EXPECT_TRUE(changes.sensors.after.empty());
}

TEST(Changes, WhatComesIsNewAndTheRestKeepsItsNumber) {
  World world = three();
  const sim::Structure before = world.structure();
  world.spawn();
  const Changes changes = changes_between(&before, world.structure());
  EXPECT_EQ(changes.models.before, (List{0, 1, 2, kNew}));
  EXPECT_EQ(changes.links.before, (List{0, 1, 2, 3, 4, 5, kNew, kNew}));
  EXPECT_EQ(changes.lights.before, (List{0, 1, 2, kNew}));
  EXPECT_EQ(changes.sensors.after, (List{0, 1, 2}));
}

TEST(Changes, WhatStandsBehindWhatHasGoneMovesUp) {
  World world = three();
  const sim::Structure before = world.structure();
  world.erase(1);
  world.spawn();
  const Changes changes = changes_between(&before, world.structure());
  EXPECT_EQ(changes.models.before, (List{0, 2, kNew}));
  EXPECT_EQ(changes.models.after, (List{0, kGone, 1}));
  EXPECT_EQ(changes.links.after, (List{0, 1, kGone, kGone, 2, 3}));
  EXPECT_EQ(changes.devices.after, (List{0, kGone, 1}));
  EXPECT_EQ(changes.sensors.before, (List{0, 2, kNew}));
}

TEST(Changes, WhatAModelHasIsNewWhereItIsDescribedAnew) {
  World world = three();
  const sim::Structure before = world.structure();
  world.redescribe(1);
  sim::Structure now = world.structure();
  sim::SensorEntry sensor = now.sensors[1];
  sensor.desc = before.sensors[1].desc;  // a sensor's stays
  now.sensors.set(1, sensor);
  const Changes changes = changes_between(&before, now);
  EXPECT_EQ(changes.models.before, (List{0, kNew, 2}));
  EXPECT_EQ(changes.sensors.before, (List{0, kNew, 2}));
  EXPECT_EQ(changes.sensors.after, (List{0, kGone, 2}));
}

TEST(Changes, SensorsOfOneDescriptionAreDistinguished) {
  World world = three();
  sim::Structure before = world.structure();
  const sim::SensorEntry first = before.sensors.back();
  sim::SensorEntry second = first;
  second.key = 7;
  before.sensors.push_back(second);
  sim::Structure now = before;
  now.sensors.truncate(2);
  now.sensors.push_back(second);
  EXPECT_EQ(changes_between(&before, now).sensors.before, (List{0, 1, 3}));
}

TEST(Changes, TheWorldsOwnLightsStayUnlessTheyChange) {
  World world = three();
  world.own_light("sun");
  world.own_light("moon");
  const sim::Structure before = world.structure();
  world.own_lights()[1].intensity = 0.5;
  world.own_light("star");
  const Changes changes = changes_between(&before, world.structure());
  EXPECT_EQ(changes.lights.before, (List{0, kNew, kNew, 2, 3, 4}));
  EXPECT_EQ(changes.lights.after, (List{0, kGone, 3, 4, 5}));
}

}  // namespace
}  // namespace angen::node

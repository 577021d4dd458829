#include <gtest/gtest.h>

#include "angen_sim/fakes.h"
#include "plugin/library.h"

namespace angen::test {
namespace {

using Parameters = std::vector<std::pair<std::string, std::string>>;

struct Lit {
  Catalog catalog;
  FakeWorld world;
  std::shared_ptr<const Plugin> kind;
  std::unique_ptr<Device> lamp;

  explicit Lit(const Parameters& parameters = {}) {
    world.lights.push_back({"bulb", {}});
    for (const auto& plugin : catalog.library("libros_plugin.so")) {
      if (plugin->kind().name == "lamp") kind = plugin;
    }
    lamp = kind->make_device();
    Params params(plugin_element(parameters));
    lamp->configure(params, world);
    params.finish();
    lamp->update(world, world);
  }
  Verdict say(const std::string& text) {
    Command command{text, {}, "", 0.0};
    const std::string wrong = parse_command(kind->kind(), command);
    if (!wrong.empty()) return Verdict::reject(wrong);
    const Verdict verdict = lamp->command(command, world);
    if (verdict.act) verdict.act();
    lamp->update(world, world);
    return verdict;
  }
  Reading state() const {
    Reading reading;
    lamp->report(world, reading);
    return reading;
  }
  const FakeLight& bulb() const { return world.lights[0].second; }
};

TEST(Lamp, IsDarkAtTheStart) {
  const Lit lit;
  EXPECT_EQ(lit.bulb().level, 0.0);
  EXPECT_FALSE(lit.state().get<bool>("on"));
}

TEST(Lamp, StartsAtItsLevel) {
  const Lit lit(Parameters{{"level", "40"}, {"luminous_flux", "500"}});
  EXPECT_DOUBLE_EQ(lit.bulb().level, 0.4);
  EXPECT_DOUBLE_EQ(lit.bulb().luminous_flux, 500.0);
  EXPECT_DOUBLE_EQ(lit.state().get<double>("luminous_flux"), 200.0);
}

TEST(Lamp, GoesOnIsDimmedAndGoesOff) {
  Lit lit;
  EXPECT_TRUE(lit.say("On").accepted);
  EXPECT_DOUBLE_EQ(lit.bulb().level, 1.0);
  EXPECT_DOUBLE_EQ(lit.state().get<double>("luminous_flux"), 800.0);
  EXPECT_TRUE(lit.say("dim 25").accepted);
  EXPECT_DOUBLE_EQ(lit.bulb().level, 0.25);
  EXPECT_DOUBLE_EQ(lit.state().get<double>("level"), 25.0);
  EXPECT_TRUE(lit.state().get<bool>("on"));
  EXPECT_TRUE(lit.say("OFF").accepted);
  EXPECT_DOUBLE_EQ(lit.bulb().level, 0.0);
  const std::vector<std::pair<std::string, std::string>> expected{
      {"on", ""}, {"dimmed", ""}, {"off", ""}};
  EXPECT_EQ(lit.world.events, expected);
}

TEST(Lamp, SameLevelAgainIsNoEvent) {
  Lit lit;
  lit.say("On");
  lit.say("On");
  EXPECT_EQ(lit.world.events.size(), 1u);
}

TEST(Lamp, RejectsWhatItDoesNotKnow) {
  Lit lit;
  for (const char* text : {"", "Onn", "Dim", "Dim x", "Dim -1", "Dim 100.1", "Dim nan", "On 1"}) {
    const Verdict verdict = lit.say(text);
    EXPECT_FALSE(verdict.accepted) << text;
    EXPECT_FALSE(verdict.reason.empty()) << text;
  }
  EXPECT_EQ(lit.bulb().level, 0.0);
}

TEST(Lamp, RejectsALevelBeyondAHundredPercent) {
  EXPECT_THROW(Lit(Parameters{{"level", "101"}}), Error);
  EXPECT_THROW(Lit(Parameters{{"luminous_flux", "0"}}), Error);
}

}  // namespace
}  // namespace angen::test

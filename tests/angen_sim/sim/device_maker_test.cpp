#include "sim/device_maker.h"

#include <set>

#include "angen_sim/sim/household.h"

namespace angen::sim {
namespace {

const std::string kSun =
    "<light name='sun' type='directional'><diffuse>0.5 0.5 0.5 1</diffuse>"
    "<direction>0 0 -1</direction></light>";
const std::string kBulb = "<light name='bulb' type='point'><pose>0 0 2 0 0 0</pose></light>";
const std::string kCar = R"(<model name='car'><static>true</static><pose>0 0 1 0 0 0</pose>
  <link name='front'><light name='left' type='spot'><spot><inner_angle>0.5</inner_angle>
    <outer_angle>1</outer_angle></spot></light><light name='right' type='point'/></link></model>)";

class OwnLamps : public ::testing::Test {
 protected:
  void load_world(const std::string& parts, load::DefaultDialect default_dialect) {
    load::SearchPaths paths;
    paths.default_dialect = default_dialect;
    world_ = simulation_of(in_world(parts), 0, std::make_shared<Catalog>(), paths);
    for (const Event& event : world_->snapshot()->events) warnings_ += event.detail + "\n";
    world_->tick();
  }
  Outcome post(Action action) {
    std::future<Outcome> answer = world_->post(std::move(action));
    world_->tick();
    return answer.get();
  }
  bool command(const std::string& name, const std::string& text) {
    return post(ToDevice{"lamp", name, {text, {}}}).ok;
  }
  std::vector<std::string> lamps() const {
    std::vector<std::string> names;
    for (const DeviceEntry& device : world_->snapshot()->structure->devices) {
      names.push_back(device.name);
    }
    return names;
  }
  const Reading& state(const std::string& name) const {
    const auto snapshot = world_->snapshot();
    for (std::size_t i = 0; i < snapshot->devices.size(); ++i) {
      if (snapshot->structure->devices[i].name == name) return *snapshot->devices[i];
    }
    throw std::runtime_error("no " + name);
  }
  /// States are reported 50 times a second.
  void report() {
    for (int i = 0; i < 20; ++i) world_->tick();
  }
  double level(std::size_t light) const { return world_->snapshot()->light_levels->at(light); }

  std::unique_ptr<Simulation> world_;
  std::string warnings_;
};

TEST_F(OwnLamps, EachLightOfATolerantWorldIsOneByItsName) {
  load_world(kSun + kBulb + kCar, load::DefaultDialect::kGazebo);
  EXPECT_EQ(lamps(), (std::vector<std::string>{"car_left", "car_right", "sun", "bulb"}));
  EXPECT_EQ(state("bulb").get<double>("level"), 100.0);
  EXPECT_EQ(state("bulb").get<double>("luminous_flux"), 800.0);
  EXPECT_EQ(state("bulb").find("illuminance"), nullptr);
  EXPECT_EQ(state("sun").get<double>("illuminance"), 500.0);
  EXPECT_EQ(state("sun").get<double>("luminous_flux"), 0.0);
  ASSERT_TRUE(command("sun", "Off"));
  ASSERT_TRUE(command("bulb", "Dim 40"));
  ASSERT_TRUE(command("car_right", "Dim 10"));
  report();
  EXPECT_EQ(level(0), 0.0);
  EXPECT_EQ(level(1), 0.4);
  EXPECT_EQ(level(2), 1.0);
  EXPECT_EQ(level(3), 0.1);
  EXPECT_EQ(state("sun").get<double>("illuminance"), 0.0);
  EXPECT_EQ(state("bulb").get<double>("luminous_flux"), 320.0);
  ASSERT_TRUE(command("all", "Off"));
  world_->tick();
  for (std::size_t light = 0; light < 4; ++light) EXPECT_EQ(level(light), 0.0);
  ASSERT_TRUE(post(Reset{true}).ok);
  world_->tick();
  for (std::size_t light = 0; light < 4; ++light) EXPECT_EQ(level(light), 1.0);
}

TEST_F(OwnLamps, OneOfAStrictWorldIsALampWhereItHasALevel) {
  const std::string dim = "<light name='dim' type='point'><angen:level>30</angen:level></light>";
  load_world(kSun + kCar + dim, load::DefaultDialect::kOwn);
  EXPECT_EQ(lamps(), std::vector<std::string>{"dim"});
  EXPECT_EQ(level(0), 1.0);
  EXPECT_EQ(level(1), 0.3);
}

TEST_F(OwnLamps, ALightThatADeviceHasIsNoSecondLamp) {
  load_world(kLamp, load::DefaultDialect::kGazebo);
  EXPECT_EQ(lamps(), std::vector<std::string>{"hall0"});
}

TEST_F(OwnLamps, ALightWhoseNameALampHasShinesAndIsNotSwitched) {
  load_world(kLamp + "<light name='hall0' type='point'/>", load::DefaultDialect::kGazebo);
  EXPECT_EQ(lamps(), std::vector<std::string>{"hall0"});
  EXPECT_NE(warnings_.find("light 'hall0' cannot be switched: there is a lamp of that name"),
            std::string::npos)
      << warnings_;
  ASSERT_TRUE(command("hall0", "Dim 20"));
  world_->tick();
  EXPECT_EQ(level(0), 1.0);
  EXPECT_EQ(level(1), 0.2);
}

TEST_F(OwnLamps, ALampDoesNotComeWhereALightHasItsName) {
  load_world("<light name='hall0' type='point'/>", load::DefaultDialect::kGazebo);
  const Outcome outcome = post(Spawn{load::model(kLamp, "", {}, {})});
  EXPECT_FALSE(outcome.ok);
  EXPECT_NE(outcome.message.find("lamp 'hall0' exists already, as a light of the world"),
            std::string::npos)
      << outcome.message;
}

TEST_F(OwnLamps, OneThatIsSpawnedIsSwitchedUntilItIsDeleted) {
  load_world("", load::DefaultDialect::kOwn);
  ASSERT_TRUE(post(Edit(AddLight{load::light(kBulb, "new", {}), kBulb})).ok);
  EXPECT_EQ(lamps(), std::vector<std::string>{"new"});
  EXPECT_EQ(world_->snapshot()->structure->devices[0].light, 0U);
  ASSERT_TRUE(command("new", "Dim 25"));
  world_->tick();
  EXPECT_EQ(level(0), 0.25);
  ASSERT_TRUE(post(Edit(DeleteLight{"new"})).ok);
  EXPECT_TRUE(lamps().empty());
  EXPECT_FALSE(command("new", "On"));
  EXPECT_TRUE(post(Edit(AddLight{load::light(kBulb, "new", {}), kBulb})).ok);
  EXPECT_EQ(lamps(), std::vector<std::string>{"new"});
}

TEST_F(OwnLamps, AnotherColorIsOfTheSameLevelAndBlackIsDark) {
  load_world(kBulb, load::DefaultDialect::kGazebo);
  ASSERT_TRUE(command("bulb", "Dim 40"));
  report();
  const auto paint = [&](float value) {
    ASSERT_TRUE(post(Edit(SetLight{"bulb", {value, value, value}, true, Vec3::Zero(), {}})).ok);
    report();
  };
  paint(0.5F);
  EXPECT_EQ(level(0), 0.4);
  EXPECT_EQ(state("bulb").get<double>("luminous_flux"), 160.0);
  ASSERT_TRUE(command("bulb", "On"));
  report();
  EXPECT_EQ(state("bulb").get<double>("luminous_flux"), 400.0);
  paint(0.0F);
  EXPECT_EQ(level(0), 0.0);
  EXPECT_FALSE(state("bulb").get<bool>("on"));
  paint(1.0F);
  EXPECT_EQ(level(0), 1.0);
  EXPECT_EQ(state("bulb").get<double>("luminous_flux"), 800.0);
}

TEST(DeviceMaker, DescribesTheBodyThatAPlugInDeclares) {
  const auto simulation = simulation_of(in_world("<actor name='ann'/>"));
  const Structure& structure = *simulation->snapshot()->structure;
  const desc::Link& body = structure.models.front()->links.front();
  EXPECT_EQ(structure.devices[0].body, 0);
  EXPECT_TRUE(body.anatomy.upright);
  EXPECT_GT(body.anatomy.side_stiffness, 0.0);
  std::set<std::string> visuals;
  for (const desc::Visual& visual : body.visuals) visuals.insert(visual.name);
  EXPECT_EQ(body.anatomy.limbs.size(), 9U);
  for (const Anatomy::Names& limb : body.anatomy.limbs) {
    for (const std::string& visual : limb) EXPECT_EQ(visuals.count(visual), 1U) << visual;
  }
}

}  // namespace
}  // namespace angen::sim

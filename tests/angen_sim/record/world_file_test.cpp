#include "record/world_file.h"

#include <cmath>

#include "angen_sim/sim/household.h"

namespace angen::record {
namespace {

const std::string kModels = std::string(ANGEN_WORLDS_DIR) + "/models";

std::unique_ptr<sim::Simulation> loaded(const std::string& text) {
  return std::make_unique<sim::Simulation>(load::world_from_text(text, "home", {{kModels}, {}}), 1,
                                           std::make_shared<Catalog>());
}

void run(sim::Simulation& simulation, double seconds) {
  const Nanoseconds end = simulation.snapshot()->time + from_seconds(seconds);
  while (simulation.snapshot()->time < end) simulation.leap(end);
}

void command(sim::Simulation& simulation, const std::string& kind, const std::string& name,
             const std::string& text) {
  auto done = simulation.post(sim::ToDevice{kind, name, {text, {}}});
  simulation.tick();
  const sim::Outcome outcome = done.get();
  EXPECT_TRUE(outcome.ok) << outcome.message;
}

std::string saved(sim::Simulation& simulation) {
  return world_file(simulation.world(), simulation.saved());
}

const Reading& state_of(const sim::Simulation& simulation, const std::string& kind) {
  const auto snapshot = simulation.snapshot();
  for (std::size_t i = 0; i < snapshot->devices.size(); ++i) {
    if (snapshot->structure->devices[i].kind == kind) return *snapshot->devices[i];
  }
  throw std::runtime_error("no " + kind);
}

std::string mode_of(const sim::Simulation& simulation, const std::string& kind) {
  return state_of(simulation, kind).get<std::string>("mode");
}

double number_in(const sim::Simulation& simulation, const std::string& kind, const char* field) {
  return state_of(simulation, kind).get<double>(field, NAN);
}

std::string home() {
  std::string text = sim::text_of_household();
  const std::string end = "</world>";
  return text.insert(text.find(end),
                     "<model name='pane'><static>true</static><pose>0 4 1 0 0 0</pose><link "
                     "name='l'><light name='l' type='point'/></link><plugin name='d' filename="
                     "'libdaylight_plugin.so'/></model>");
}

TEST(WorldFile, KeepsWhatDevicesAreSetTo) {
  const auto before = loaded(home());
  run(*before, 1.0);
  command(*before, "lamp", "hall0", "Dim 40");
  command(*before, "heater", "stove", "Set 30");
  command(*before, "daylight", "pane0", "Set 2000");
  command(*before, "battery", "stove_battery", "Charge 50");
  command(*before, "climate", "flat", "Outside -10");
  command(*before, "door", "hall0", "Open");
  run(*before, 60.5);  // not just before the messages of each second
  const auto after = loaded(saved(*before));
  after->tick();
  for (const auto& [kind, field, tolerance] :
       {std::tuple<const char*, const char*, double>{"lamp", "level", 0.0},
        {"lamp", "power", 0.0},
        {"heater", "level", 0.0},
        {"daylight", "illuminance", 0.0},
        {"battery", "percentage", 1e-6},
        {"climate", "outside_temperature", 0.0},
        {"door", "position", 1e-6},
        {"door", "target", 1e-3}}) {
    EXPECT_NEAR(number_in(*after, kind, field), number_in(*before, kind, field), tolerance)
        << kind << " " << field;
  }
  EXPECT_EQ(number_in(*after, "lamp", "level"), 40.0);
  EXPECT_EQ(mode_of(*after, "door"), "OPEN");
  EXPECT_EQ(*after->snapshot()->light_levels, *before->snapshot()->light_levels);
  const auto air = [](const sim::Simulation& s) {
    return state_of(s, "climate").get<std::vector<double>>("temperatures");
  };
  ASSERT_EQ(air(*after).size(), 2U);
  EXPECT_NE(air(*before)[0], air(*before)[1]);
  for (int room = 0; room < 2; ++room) EXPECT_NEAR(air(*after)[room], air(*before)[room], 1e-3);
}

TEST(WorldFile, LeavesUntouchedDevicesAsTheirFilesHaveThem) {
  const auto simulation = loaded(home());
  const std::string text = saved(*simulation);
  for (const char* name : {"<level>", "<illuminance>", "<target>", "<air>"}) {
    EXPECT_EQ(text.find(name), std::string::npos) << name;
  }
}

// But for its speed, which is not saved: 1 m/s is caught up with in 0.2 s.
TEST(WorldFile, KeepsWherePeopleAreOnTheirWay) {
  const std::string walk =
      "<sdf version='1.6'><world name='w'>" + sim::kPerson +
      sim::body("floor", "<box><size>9 9 0.2</size></box>", "0 0 -0.1 0 0 0", true) +
      "</world></sdf>";
  for (const double seconds :
       {3.0, 8.5, 12.0, 24.0}) {  // stands, walks, stands, in the second round
    const auto before = loaded(walk);
    run(*before, seconds);
    const auto after = loaded(saved(*before));
    for (int second = 0; second < 15; ++second) {
      run(*before, 1.0);
      run(*after, 1.0);
      for (const char* field : {"x", "y", "z"}) {
        EXPECT_NEAR(number_in(*after, "person", field), number_in(*before, "person", field), 0.2)
            << field << " " << seconds << " s and " << second;
      }
    }
  }
}

TEST(WorldFile, KeepsThatAPersonWasStopped) {
  const auto before = loaded(home());
  run(*before, 8.0);
  command(*before, "person", "person", "Stop");
  run(*before, 2.0);
  const auto after = loaded(saved(*before));
  run(*after, 20.0);
  EXPECT_NEAR(number_in(*after, "person", "x"), number_in(*before, "person", "x"), 0.01);
  command(*after, "person", "person", "Go");
  run(*after, 20.0);
  EXPECT_EQ(loaded(saved(*after))->snapshot()->structure->devices.size(),
            before->snapshot()->structure->devices.size())
      << "a saved world that was loaded is saved again";
}

TEST(WorldFile, KeepsADoorOnItsWay) {
  const auto before = loaded(home());
  run(*before, 0.5);
  command(*before, "door", "hall0", "Open");
  run(*before, 1.0);
  ASSERT_EQ(mode_of(*before, "door"), "OPENING");
  const auto after = loaded(saved(*before));
  run(*after, 10.0);
  EXPECT_EQ(mode_of(*after, "door"), "OPEN");
  command(*after, "door", "hall0", "Close");
  run(*after, 10.0);
  const auto again = loaded(saved(*after));
  run(*again, 10.0);
  EXPECT_EQ(mode_of(*again, "door"), "CLOSED") << "where it went before is forgotten";
}

TEST(WorldFile, KeepsWhereAnElevatorGoes) {
  const auto before = loaded(
      "<sdf version='1.6'><world name='w'><include><uri>model://elevator</uri>"
      "<plugin name='p' filename='libros_plugin.so'><queue_size>2</queue_size></plugin>"
      "</include></world></sdf>");
  const std::string name = before->snapshot()->structure->devices[0].name;
  run(*before, 1.0);
  command(*before, "elevator", name, "Floor1");
  command(*before, "elevator", name, "Floor0");
  run(*before, 6.0);
  ASSERT_EQ(mode_of(*before, "elevator"), "UP");
  const auto after = loaded(saved(*before));
  bool came_up = false;
  for (int second = 0; second < 40; ++second) {
    run(*after, 1.0);
    came_up = came_up || state_of(*after, "elevator").get<std::int64_t>("floor") == 1;
  }
  EXPECT_TRUE(came_up);
  EXPECT_EQ(state_of(*after, "elevator").get<std::int64_t>("floor"), 0);
}

// Entities added, removed and changed in the tick of a save get other numbers.
TEST(WorldFile, IsOfTheMomentAfterAllThatIsCarriedOutWithIt) {
  const auto world = loaded(
      "<sdf version='1.6'><world name='w'><model name='a'><link name='l'/></model><model name='b'>"
      "<link name='l'/></model><light name='old' type='point'/></world></sdf>");
  world->tick();
  desc::Light light;
  light.name = "late";
  sim::SetLinkProperties heavy;
  heavy.link = "b::l";
  heavy.inertial.mass = 3.0;
  const auto state = std::make_shared<sim::SavedState>();
  world->post(sim::Delete{"a"});
  world->post(sim::Edit(heavy));
  world->post(sim::Edit(sim::AddLight{light, "<light name='late' type='point'/>"}));
  auto done = world->post(sim::Save{state});
  world->tick();
  ASSERT_TRUE(done.get().ok);
  const std::string text = world_file(world->world(), *state);
  EXPECT_EQ(text.find("<model name=\"a\""), std::string::npos);
  EXPECT_NE(text.find("<mass>3</mass>"), std::string::npos);
  EXPECT_NE(text.find("\"late\""), std::string::npos);
  EXPECT_EQ(loaded(text)->snapshot()->structure->models.size(), 1U);
}

TEST(WorldFile, DeclaresThePrefixOfWhatItSays) {
  const auto text_of = [](load::DefaultDialect default_dialect) {
    load::SearchPaths paths;
    paths.default_dialect = default_dialect;
    sim::Simulation simulation(
        load::world_from_text("<sdf version='1.6'><world name='w'/></sdf>", "w", paths), 1,
        std::make_shared<Catalog>());
    return saved(simulation);
  };
  const std::string guessed = text_of(load::DefaultDialect::kAuto);
  EXPECT_NE(guessed.find("angen:strict"), std::string::npos);
  EXPECT_NE(guessed.find("xmlns:angen="), std::string::npos);
  EXPECT_EQ(text_of(load::DefaultDialect::kOwn).find("xmlns"), std::string::npos);
  EXPECT_TRUE(load::world_from_text(guessed, "again", {}).warnings.empty());
}

// A world without a plug-in of Angen's, so that each light is a lamp.
TEST(WorldFile, KeepsLightsAsTheyAreNow) {
  const auto read = [](const std::string& text) {
    load::SearchPaths paths{{kModels}, {}};
    paths.default_dialect = load::DefaultDialect::kAuto;
    return std::make_unique<sim::Simulation>(load::world_from_text(text, "lights", paths), 1,
                                             std::make_shared<Catalog>());
  };
  const auto before = read(
      "<sdf version='1.6'><world name='w'><include><uri>model://sun</uri></include>"
      "<light name='gone' type='point'/><light name='same' type='spot'><spot><inner_angle>1"
      "</inner_angle><outer_angle>2</outer_angle><falloff>1</falloff></spot></light>"
      "<model name='car'><static>true</static><link name='l'><light name='left' type='point'/>"
      "</link></model></world></sdf>");
  const auto edit = [&](sim::Edit edit) {
    auto done = before->post(std::move(edit));
    before->tick();
    EXPECT_TRUE(done.get().ok);
  };
  const Pose up{{1.0, 2.0, 3.0}, Quat::Identity()};
  const std::string spawned = "<light name='any' type='spot'><pose>0 0 1 0 0 0</pose></light>";
  edit(sim::SetLight{"sun", {0.5F, 0.25F, 0.5F}, false, {0.0, 0.6, -0.8}, up});
  edit(sim::AddLight{load::light(spawned, "new", up), spawned});
  edit(sim::DeleteLight{"gone"});
  command(*before, "lamp", "sun", "Dim 40");
  command(*before, "lamp", "car_left", "Off");
  run(*before, 0.1);
  const auto after = read(saved(*before));
  after->tick();
  const auto& was = before->snapshot()->structure->lights;
  const auto& is = after->snapshot()->structure->lights;
  ASSERT_EQ(is.size(), 4U);
  for (std::size_t i = 0; i < is.size(); ++i) {
    EXPECT_EQ(is[i].name, was[i].name);
    EXPECT_EQ(is[i].light.type, was[i].light.type) << is[i].name;
    EXPECT_EQ(is[i].light.diffuse, was[i].light.diffuse) << is[i].name;
    EXPECT_EQ(is[i].light.cast_shadows, was[i].light.cast_shadows) << is[i].name;
    EXPECT_TRUE(is[i].light.pose.position.isApprox(was[i].light.pose.position)) << is[i].name;
    EXPECT_TRUE(is[i].light.direction.isApprox(was[i].light.direction)) << is[i].name;
  }
  EXPECT_EQ(*after->snapshot()->light_levels, *before->snapshot()->light_levels);
  EXPECT_EQ(*after->snapshot()->light_levels, (std::vector<double>{0.4, 1.0, 1.0, 0.0}));
  EXPECT_EQ(saved(*read(saved(*before))), saved(*before));
  auto reset = before->post(sim::Reset{true});
  run(*before, 0.1);
  EXPECT_EQ(saved(*before).find("<angen:level>"), saved(*before).rfind("<angen:level>"))
      << "only the spawned one says that it is a lamp";
}

// As Gazebo's services set them.
TEST(WorldFile, KeepsWhatEditsHaveChanged) {
  const auto before = loaded(home());
  desc::Physics physics = before->snapshot()->structure->physics;
  physics.iterations = 33;
  const auto edit = [&](sim::Edit edit) {
    auto done = before->post(std::move(edit));
    before->tick();
    const sim::Outcome outcome = done.get();
    EXPECT_TRUE(outcome.ok) << outcome.message;
  };
  edit(sim::SetPhysics{physics, {0.0, 0.0, -1.625}});
  desc::Inertial inertial;
  inertial.mass = 4.5;
  inertial.moment = 2.0 * Eigen::Matrix3d::Identity();
  edit(sim::SetLinkProperties{"brick::link", inertial, false});
  sim::SetJointProperties hinge;
  hinge.joint = "hall_door::hinge";
  hinge.damping = {0.625};
  edit(hinge);
  auto reset = before->post(sim::Reset{true});  // changes none of it
  run(*before, 0.1);
  const auto after = loaded(saved(*before));
  const sim::Structure& now = *after->snapshot()->structure;
  EXPECT_EQ(now.gravity, Vec3(0.0, 0.0, -1.625));
  EXPECT_EQ(now.physics.iterations, 33);
  for (const auto& model : now.models) {
    if (model->name == "brick") {
      EXPECT_EQ(model->links[0].inertial.mass, 4.5);
      EXPECT_FALSE(model->links[0].gravity);
    }
    if (model->name == "hall_door") {
      EXPECT_EQ(model->joints[1].axes[0].damping, 0.625);
    }
  }
}

TEST(WorldFile, IsTheSameFromAnyThread) {
  const auto simulation = loaded(home());
  run(*simulation, 5.0);
  const auto state = std::make_shared<sim::SavedState>();
  auto done = simulation->post(sim::Pause{true});
  simulation->tick();
  auto saving = simulation->post(sim::Save{state});
  simulation->tick();
  ASSERT_TRUE(saving.get().ok);
  EXPECT_EQ(world_file(simulation->world(), *state), saved(*simulation));
}

}  // namespace
}  // namespace angen::record

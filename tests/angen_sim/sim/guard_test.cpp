// Plug-ins that throw: each is stopped and says so, the others and the world go on.
#include "sim/guard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <new>
#include <stdexcept>

#include "angen_sim/sim/room.h"
#include "plugin/outputs.h"
#include "plugin/view.h"

namespace angen::sim {
namespace {

/// The call in which a plug-in of the test throws: "configure", "update", "report", "command",
/// "act", "aim", "read", "skip". With "push" a device pushes by NaN.
class Thrower {
 public:
  void configure(Params& params) {
    where_ = params.text("throws", "", "where it throws");
    pass("configure");
  }
  bool is(const std::string& place) const { return place == where_; }
  void pass(const std::string& place) const {
    if (place != where_) return;
    if (place == "aim") throw std::bad_alloc();
    if (place == "read" || place == "act" || place == "configure")
      throw 42;  // NOLINT: not a std::exception, on purpose
    throw std::out_of_range("in " + place);
  }

 private:
  std::string where_;
};

class ThrowingDevice : public Device {
 public:
  void configure(Params& params, Wiring&) override { thrower_.configure(params); }
  Verdict command(const Command&, const View&) override {
    thrower_.pass("command");
    return Verdict::accept([this] { thrower_.pass("act"); });
  }
  void update(const View&, Outputs& outputs) override {
    thrower_.pass("update");
    const Vec3 none = Vec3::Zero();
    if (thrower_.is("push")) outputs.push({}, Vec3::Constant(std::nan("")), none, none);
  }
  void report(const View& view, Reading& state) const override {
    state.set("time", to_seconds(view.time()));
    if (view.time() > 100 * kSecond / 1000) thrower_.pass("report");
  }

 private:
  Thrower thrower_;
};

class ThrowingSensor : public Sensor {
 public:
  void configure(Params& params, Wiring&) override { thrower_.configure(params); }
  void aim(const View& view, RayBatch& rays) override {
    rays.push_back({view.pose().position, {0, 0, -1}, 0.0, 10.0});
    thrower_.pass("aim");
  }
  void read(const View& view, Hits hits, Rng&, Reading& reading) override {
    reading.set("range", hits[0].range);
    if (view.time() > 200 * kSecond / 1000) thrower_.pass("read");
  }

 private:
  Thrower thrower_;
};

class ThrowingPlugin : public Plugin {
 public:
  explicit ThrowingPlugin(bool is_sensor)
      : kind_(is_sensor ? "probe" : "bomb", "throws"), is_sensor_(is_sensor) {
    if (is_sensor) {
      kind_.rate(10.0);
    } else {
      kind_.verb("Go", "may throw");
    }
  }
  const Kind& kind() const override { return kind_; }
  bool serves(const ModelInfo&) const override { return !is_sensor_; }
  std::unique_ptr<Device> make_device() const override {
    return is_sensor_ ? nullptr : std::make_unique<ThrowingDevice>();
  }
  std::unique_ptr<Sensor> make_sensor(Params&) const override {
    return is_sensor_ ? std::make_unique<ThrowingSensor>() : nullptr;
  }

 private:
  Kind kind_;
  bool is_sensor_;
};

std::string bomb(const std::string& name, const std::string& where) {
  return "<model name='" + name +
         "'><static>true</static><link name='l'/><plugin name='p' filename='bomb.so'><throws>" +
         where + "</throws></plugin></model>";
}

std::string probe(const std::string& name, const std::string& where) {
  return "<model name='" + name +
         "'><static>true</static><pose>0 0 1 0 0 0</pose><link name='l'><sensor name='s' "
         "type='ray'><plugin name='p' filename='probe.so'><throws>" +
         where + "</throws></plugin></sensor></link></model>";
}

std::unique_ptr<Simulation> world_with_bombs(const std::string& models) {
  const auto catalog = std::make_shared<Catalog>();
  catalog->add("bomb.so", std::make_shared<ThrowingPlugin>(false));
  catalog->add("probe.so", std::make_shared<ThrowingPlugin>(true));
  const std::string floor =
      "<model name='floor'><static>true</static><link name='link'><collision name='c'><geometry>"
      "<plane><normal>0 0 1</normal></plane></geometry></collision></link></model>";
  return simulation_of(in_world(floor + models), 0, catalog);
}

std::vector<Event> run(Simulation& simulation, int ticks) {
  std::vector<Event> events;
  for (int i = 0; i < ticks; ++i) {
    const auto snapshot = simulation.tick();
    events.insert(events.end(), snapshot->events.begin(), snapshot->events.end());
  }
  return events;
}

const Reading& state(const Simulation& simulation, const std::string& name) {
  const auto snapshot = simulation.snapshot();
  const auto& devices = snapshot->structure->devices;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (devices[i].name == name) return *snapshot->devices[i];
  }
  throw std::out_of_range(name);
}

/// A sensor and a device whose kind declares a number `value`, and the fields that they set
/// instead.
class WrongField : public Sensor {
 public:
  void configure(Params& params, Wiring&) override {
    sets_ = params.text("sets", "value", "the field that it sets");
    as_ = params.choice("as", "number", {"number", "integer", "text"}, "and to what");
    later_ = params.number("later", 0.0, "s", "not before");
    if (params.flag("noisy", false, "its noise is of a field that is not declared")) {
      params.noise("valeu", "", "");
    }
  }
  void read(const View& view, Hits, Rng&, Reading& reading) override {
    reading.set("value", 1.5);
    if (to_seconds(view.time()) < later_) return;
    const int whole = static_cast<int>(view.time() / (100 * kSecond / 1000));
    if (as_ == "number") reading.set(sets_.c_str(), 0.5);
    if (as_ == "integer") reading.set(sets_.c_str(), whole);
    if (as_ == "text") reading.set(sets_.c_str(), "much");
  }

 private:
  std::string sets_;
  std::string as_;
  double later_ = 0.0;
};

class WrongState : public Device {
 public:
  void configure(Params&, Wiring&) override {}
  void update(const View&, Outputs&) override {}
  void report(const View&, Reading& state) const override { state.set("valeu", 1.0); }
};

class WrongPlugin : public Plugin {
 public:
  explicit WrongPlugin(bool is_sensor) : is_sensor_(is_sensor) {}
  const Kind& kind() const override { return kind_; }
  bool serves(const ModelInfo&) const override { return !is_sensor_; }
  std::unique_ptr<Device> make_device() const override {
    return is_sensor_ ? nullptr : std::make_unique<WrongState>();
  }
  std::unique_ptr<Sensor> make_sensor(Params&) const override {
    return is_sensor_ ? std::make_unique<WrongField>() : nullptr;
  }

 private:
  Kind kind_ = Kind("wrong", "").rate(10.0).number("value", "", "");
  bool is_sensor_;
};

std::unique_ptr<Simulation> world_of_wrong(const std::string& parameters) {
  const auto catalog = std::make_shared<Catalog>();
  catalog->add("sensor.so", std::make_shared<WrongPlugin>(true));
  catalog->add("device.so", std::make_shared<WrongPlugin>(false));
  const std::string inside = parameters.empty()
                                 ? "<link name='l'/><plugin name='p' filename='device.so'/>"
                                 : "<link name='l'><sensor name='s' type='ray'><plugin name='p' "
                                   "filename='sensor.so'>" +
                                       parameters + "</plugin></sensor></link>";
  return simulation_of(in_world("<model name='m'><static>true</static>" + inside + "</model>"), 0,
                       catalog);
}

TEST(AField, ThatIsNotDeclaredFailsTheSensorWhenItIsSet) {
  const auto simulation = world_of_wrong("<sets>valeu</sets>");
  const std::vector<Event> events = run(*simulation, 1000);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].event, "failed");
  EXPECT_EQ(events[0].detail,
            "kind 'wrong' does not declare the field 'valeu'; did you mean value?");
  EXPECT_EQ(simulation->snapshot()->reading(0)->get<std::string>(kErrorField), events[0].detail);
}

TEST(AField, ThatIsSetLaterIsCheckedThen) {
  const auto simulation = world_of_wrong("<sets>valeu</sets><later>0.5</later>");
  EXPECT_TRUE(run(*simulation, 400).empty());
  EXPECT_EQ(run(*simulation, 400).size(), 1U);
}

TEST(AField, OfAnotherTypeFailsTheSensor) {
  const auto simulation = world_of_wrong("<as>text</as>");
  const std::vector<Event> events = run(*simulation, 1000);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NE(events[0].detail.find("declares it as number"), std::string::npos);
}

TEST(AField, ThatIsANumberTakesIntegers) {
  const auto simulation = world_of_wrong("<as>integer</as>");
  EXPECT_TRUE(run(*simulation, 950).empty());
  const auto reading = simulation->snapshot()->reading(0);
  ASSERT_NE(reading->get_if<double>("value"), nullptr);
  EXPECT_EQ(reading->get<double>("value"), 9.0);
}

TEST(AField, WithNoiseThatIsNotDeclaredIsRejectedWhenItsWorldIsLoaded) {
  EXPECT_THROW(world_of_wrong("<noisy>true</noisy>"), Error);
}

TEST(AField, ThatIsNotDeclaredFailsTheDevice) {
  const auto simulation = world_of_wrong("");
  const std::vector<Event> events = run(*simulation, 200);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].event, "failed");
  EXPECT_NE(events[0].detail.find("did you mean value?"), std::string::npos);
}

TEST(ADevice, ThatPushesByNaNFails) {
  const auto simulation = world_with_bombs(bomb("bad", "push"));
  const std::vector<Event> events = run(*simulation, 200);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].event, "failed");
  EXPECT_EQ(events[0].detail, "push() was given NaN");
}

TEST(APlugin, ThatThrowsInConfigureIsAnErrorAtItsLine) {
  for (const std::string& model : {bomb("bad", "configure"), probe("bad", "configure")}) {
    try {
      world_with_bombs(model);
      FAIL() << "it was made";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(":1: an exception that is not a std::exception"),
                std::string::npos)
          << error.what();
    }
  }
}

class ADeviceThatThrows : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(In, ADeviceThatThrows, ::testing::Values("update", "report"));

TEST_P(ADeviceThatThrows, IsStoppedAndSaysSoOnce) {
  const auto simulation = world_with_bombs(bomb("bad", GetParam()) + bomb("good", ""));
  const std::vector<Event> events = run(*simulation, 1000);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].source, "bad");
  EXPECT_EQ(events[0].kind, "bomb");
  EXPECT_EQ(events[0].event, "failed");
  EXPECT_EQ(events[0].detail, std::string("in ") + GetParam());
  EXPECT_EQ(state(*simulation, "bad").get<std::string>(kErrorField), events[0].detail);
  EXPECT_GT(state(*simulation, "good").get<double>("time"), 0.9);
  EXPECT_EQ(state(*simulation, "good").find(kErrorField), nullptr);
  const auto saved = std::make_shared<SavedState>();
  simulation->post(Save{saved});
  run(*simulation, 1);
  EXPECT_NE(saved->snapshot, nullptr);
}

TEST_P(ADeviceThatThrows, RejectsCommandsAndStartsAgainWithTheWorld) {
  const auto simulation = world_with_bombs(bomb("bad", GetParam()));
  run(*simulation, 200);
  std::future<Outcome> answer = simulation->post(ToDevice{"bomb", "bad", {"Go", {}, "", 0.0}});
  run(*simulation, 1);
  const Outcome outcome = answer.get();
  EXPECT_FALSE(outcome.ok);
  EXPECT_NE(outcome.message.find("has failed: in"), std::string::npos) << outcome.message;
  simulation->post(Reset{});
  EXPECT_EQ(run(*simulation, 200).back().event, "failed");  // called again, it throws again
}

class ACommandThatThrows : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(In, ACommandThatThrows, ::testing::Values("command", "act"));

TEST_P(ACommandThatThrows, IsAnsweredAndTheDeviceGoesOn) {
  const auto simulation = world_with_bombs(bomb("bad", GetParam()));
  std::future<Outcome> answer = simulation->post(ToDevice{"bomb", "bad", {"Go", {}, "", 0.0}});
  const std::vector<Event> events = run(*simulation, 1000);
  const Outcome outcome = answer.get();
  EXPECT_FALSE(outcome.ok);
  const std::string why = GetParam() == std::string("act") ? "not a std::exception" : "in command";
  EXPECT_NE(outcome.message.find(why), std::string::npos) << outcome.message;
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].event, "rejected");
  EXPECT_GT(state(*simulation, "bad").get<double>("time"), 0.9);
}

class ASensorThatThrows : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(In, ASensorThatThrows, ::testing::Values("aim", "read"));

TEST_P(ASensorThatThrows, IsStoppedAndTheOthersReadAsWithoutIt) {
  const std::string first = probe("first", ""), last = probe("last", "");
  const auto with = world_with_bombs(first + probe("bad", GetParam()) + last);
  const auto without = world_with_bombs(first + last);
  std::vector<Event> events;
  for (int i = 0; i < 1000; ++i) {
    const auto a = with->tick(), b = without->tick();
    events.insert(events.end(), a->events.begin(), a->events.end());
    for (const auto& [mine, other] : {std::pair{0, 0}, std::pair{2, 1}}) {
      const auto one = a->reading(mine), two = b->reading(other);
      ASSERT_EQ(one == nullptr, two == nullptr);
      if (one == nullptr) continue;
      EXPECT_TRUE(one->same_values(*two)) << a->time;
    }
  }
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].event, "failed");
  const auto reading = with->snapshot()->reading(1);
  EXPECT_EQ(reading->get<std::string>(kErrorField), events[0].detail);
  EXPECT_NEAR(with->snapshot()->reading(2)->get<double>("range"), 1.0, 1e-6);
}

TEST(Spawn, WithALibraryPathNoFileSystemTakesIsAnswered) {
  const auto simulation = world_with_bombs("");
  for (const std::string& path :
       {"/" + std::string(300, 'x') + "/lib.so", std::string(5000, 'y') + ".so"}) {
    const std::string model =
        "<sdf version='1.6'><model name='m'><link name='l'/><plugin name='p' "
        "filename='" +
        path + "'/></model></sdf>";
    std::future<Outcome> answer = simulation->post(Spawn{load::model(model, "m", {}, {})});
    run(*simulation, 1);
    const Outcome outcome = answer.get();
    EXPECT_FALSE(outcome.ok);
    EXPECT_NE(outcome.message.find("plug-in library"), std::string::npos) << outcome.message;
    EXPECT_LT(outcome.message.size(), 2000U);
    EXPECT_EQ(simulation->snapshot()->structure->models.size(), 1U);
  }
}

}  // namespace
}  // namespace angen::sim

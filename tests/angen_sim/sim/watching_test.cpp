// What a sensor that rests and casts few rays reads, against one that looks every time with all.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "angen_sim/sim/household.h"

namespace angen::sim {
namespace {

/// Takes away what a sensor says of its stances and its rest: it aims and reads at each due time.
class Restless : public Sensor {
 public:
  explicit Restless(std::unique_ptr<Sensor> sensor) : sensor_(std::move(sensor)) {}
  void configure(Params& params, Wiring& wiring) override { sensor_->configure(params, wiring); }
  Nanoseconds sample_period() const override { return sensor_->sample_period(); }
  double default_rate() const override { return sensor_->default_rate(); }
  void aim(const View& view, RayBatch& rays) override {
    sensor_->stance(view);
    sensor_->aim(view, rays);
  }
  void read(const View& view, Hits hits, Rng& rng, Reading& reading) override {
    sensor_->read(view, hits, rng, reading);
  }

 private:
  std::unique_ptr<Sensor> sensor_;
};

class RestlessPlugin : public Plugin {
 public:
  explicit RestlessPlugin(std::shared_ptr<const Plugin> plugin) : plugin_(std::move(plugin)) {}
  std::string kind() const override { return plugin_->kind(); }
  std::string doc() const override { return plugin_->doc(); }
  std::unique_ptr<Sensor> make_sensor() const override {
    return std::make_unique<Restless>(plugin_->make_sensor());
  }

 private:
  std::shared_ptr<const Plugin> plugin_;
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
    text.replace(at, from.size(), to);
    at += to.size();
  }
  return text;
}

const std::vector<std::string> kLibraries = {kPir,
                                             "liboptical_switch_controller.so",
                                             "libluminosity_sensor_controller.so",
                                             "libgazebo_ros_bumper.so",
                                             "libgazebo_ros_range.so",
                                             "libtemperature_sensor.so",
                                             "libhumidity_sensor.so",
                                             "libsmart_plug.so",
                                             "libpressure_mat.so",
                                             "libreed_contact.so",
                                             "librfid_reader.so"};

std::shared_ptr<Catalog> catalog() {
  static const auto shared = [] {
    auto made = std::make_shared<Catalog>();
    for (const std::string& library : kLibraries) {
      made->add("restless_" + library,
                std::make_shared<RestlessPlugin>(made->library(library).at(0)));
    }
    return made;
  }();
  return shared;
}

std::string restless(std::string text) {
  for (const std::string& library : kLibraries) {
    text = replaced(text, "'" + library, "'restless_" + library);
  }
  return text;
}

std::unique_ptr<Simulation> make(const std::string& text) {
  return std::make_unique<Simulation>(load::world_from_text(text, "test", {}), 3, catalog());
}

void expect_made_at_each_due_time(const Snapshot& snapshot) {
  for (std::size_t i = 0; i < snapshot.sensors.size(); ++i) {
    const Told& told = snapshot.sensors[i];
    if (told.reading == nullptr) continue;
    EXPECT_EQ(told.reading->stamp, snapshot.stamp(i));
    EXPECT_EQ(told.echo, nullptr);
  }
}

/// Both take the same ticks and commands and are compared at each tick.
struct Twins {
  std::unique_ptr<Simulation> calm;
  std::unique_ptr<Simulation> eager;

  explicit Twins(const std::string& text = room())
      : calm(make(text)), eager(make(restless(text))) {}

  void command(const Action& action, const Action& same) {
    calm->post(action);
    eager->post(same);
  }
  void spawn(const std::string& model, const Vec3& at) {
    const auto parse = [&](const std::string& text) {
      return Spawn{load::model(text, "", {at, Quat::Identity()}, load::SearchPaths{})};
    };
    command(parse(model), parse(restless(model)));
  }
  void order(const std::string& kind, const std::string& name, const std::string& text) {
    command(ToDevice{kind, name, {text, {}}}, ToDevice{kind, name, {text, {}}});
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      expect_same_readings(*calm->tick(), *eager->tick());
      expect_made_at_each_due_time(*eager->snapshot());
      if (::testing::Test::HasFailure()) return;
    }
  }
};

struct AtRest {
  int kept = 0;    // sensors whose reading stands for later ones
  int echoed = 0;  // sensors whose echo does
};

AtRest at_rest(const Snapshot& snapshot) {
  AtRest count;
  for (std::size_t i = 0; i < snapshot.sensors.size(); ++i) {
    const Told& told = snapshot.sensors[i];
    if (told.reading == nullptr || told.reading->stamp == snapshot.stamp(i)) continue;
    ++(told.echo ? count.echoed : count.kept);
  }
  return count;
}

TEST(Watching, ReadingsAreThoseOfCastingAllRaysAtEachDueTime) {
  Twins twins;
  twins.run(6000);
  const AtRest rest = at_rest(*twins.calm->snapshot());
  EXPECT_GT(rest.kept, 0);
  EXPECT_GT(rest.echoed, 2);
}

TEST(Watching, AHouseholdIsReadAsAtEachDueTime) {
  Twins twins(text_of_household());
  twins.run(6000);
  for (const char* order : {"On", "Off"}) {
    twins.order("heater", "stove", order);
    twins.run(1500);
    twins.order("lamp", "hall0", order);
    twins.run(1500);
  }
  twins.order("person", "person", "Stop");
  twins.order("door", "hall0", "Open");
  twins.run(8000);
  EXPECT_GT(at_rest(*twins.calm->snapshot()).echoed, 0);
}

TEST(Watching, LightAndContactsAreReadAsAtEachDueTime) {
  Twins twins(text_of_world());
  twins.order("lamp", "hall0", "On");
  twins.run(12000);
  twins.order("person", "person", "Stop");
  twins.run(3000);
  EXPECT_GT(at_rest(*twins.calm->snapshot()).echoed, 4);
  twins.order("lamp", "hall0", "Dim 40");
  twins.run(2000);
  twins.order("door", "hall0", "Open");
  twins.run(4000);
  twins.order("lamp", "hall0", "Off");
  twins.run(2000);
}

TEST(Watching, WhatIsSpawnedOrDeletedIsSeenAtOnce) {
  Twins twins;
  twins.run(4000);
  twins.spawn(body("post", "<cylinder><radius>0.1</radius><length>2</length></cylinder>",
                   "0 0 0 0 0 0", true),
              {1.8, 0.6, 1.0});
  twins.run(300);
  twins.spawn(body("drop", "<sphere><radius>0.25</radius></sphere>", "0 0 0 0 0 0", false,
                   ray_sensor("dropped", kPir, 10, 0.0)),
              {-1.6, -0.9, 1.0});
  twins.run(1500);
  for (const char* gone : {"post", "wall", "drop", "brick"}) {
    twins.command(Delete{gone}, Delete{gone});
    twins.run(300);
  }
  twins.command(Reset{false}, Reset{false});
  twins.run(500);
  twins.command(Reset{true}, Reset{true});
  twins.run(500);
}

TEST(Watching, AStillSensorKeepsItsReadingAndPublishesItAgain) {
  const auto world = make("<sdf version='1.6'><world name='w'>" +
                          body("it", "<box><size>0.1 0.1 0.1</size></box>", "0 0 1 0 0 0", true,
                               ray_sensor("a", kPir, 10, 0.0)) +
                          "</world></sdf>");
  const auto first = world->tick();
  for (int i = 0; i < 1000; ++i) world->tick();
  const auto later = world->snapshot();
  EXPECT_EQ(later->sensors[0].reading, first->sensors[0].reading);
  EXPECT_EQ(later->stamp(0), kSecond);
  EXPECT_EQ(later->counts.readings, 11U);
}

}  // namespace
}  // namespace angen::sim

// Readings of a sensor that skips samples and casts few rays, against one that samples at each due
// time with all its rays.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "angen_sim/sim/household.h"
#include "plugin/view.h"

namespace angen::sim {
namespace {

/// Another view's answers; light is measured without remembering any.
class Forgetful : public View {
 public:
  explicit Forgetful(const View& view) : view_(view) {}
  Nanoseconds time() const override { return view_.time(); }
  Nanoseconds step() const override { return view_.step(); }
  Vec3 gravity() const override { return view_.gravity(); }
  Pose pose() const override { return view_.pose(); }
  JointView joint(JointRef joint) const override { return view_.joint(joint); }
  JointWrench wrench(JointRef joint) const override { return view_.wrench(joint); }
  LinkView link(LinkRef link) const override { return view_.link(link); }
  std::vector<ContactPair> contacts(ContactRef collision) const override {
    return view_.contacts(collision);
  }
  std::vector<ContactPair> contacts_within(ContactRef collision,
                                           Nanoseconds period) const override {
    return view_.contacts_within(collision, period);
  }
  std::vector<DeviceView> devices(const std::string& field,
                                  const Eigen::AlignedBox3d& within) const override {
    return view_.devices(field, within);
  }
  std::optional<DeviceView> device(const std::string& field, const std::string& kind,
                                   const std::string& name) const override {
    return view_.device(field, kind, name);
  }
  bool has_device(const std::string& field, const std::string& kind,
                  const std::string& name) const override {
    return view_.has_device(field, kind, name);
  }
  const Home& home() const override { return view_.home(); }
  const rays::Scene& rays() const override { return view_.rays(); }
  std::vector<std::uint32_t> own_shapes() const override { return view_.own_shapes(); }
  light::Sample illuminance(light::Probe&, const Pose& pose) const override {
    light::Probe fresh;
    return view_.illuminance(fresh, pose);
  }
  double ambient_temperature() const override { return view_.ambient_temperature(); }
  const std::vector<rays::WarmShape>& warm_shapes() const override { return view_.warm_shapes(); }
  Revisions watch(const std::function<std::vector<rays::Ray>()>&) const override {
    return {view_.rays().revision(), view_.watch([] { return RayBatch{}; }).temperatures};
  }
  std::vector<std::uint8_t> colors(const render::PinholeCamera& lens,
                                   const Pose& pose) const override {
    return view_.colors(lens, pose);
  }
  std::vector<float> depths(const render::PinholeCamera& lens, const Pose& pose) const override {
    return view_.depths(lens, pose);
  }

 private:
  const View& view_;
};

/// Hides a sensor's ray sets and until when it is idle: it aims and reads at each due time.
class Restless : public Sensor {
 public:
  explicit Restless(std::unique_ptr<Sensor> sensor) : sensor_(std::move(sensor)) {}
  void configure(Params& params, Wiring& wiring) override { sensor_->configure(params, wiring); }
  Nanoseconds sample_period() const override { return sensor_->sample_period(); }
  void aim(const View& view, RayBatch& rays) override {
    sensor_->ray_set(view);
    sensor_->aim(view, rays);
  }
  void read(const View& view, Hits hits, Rng& rng, Reading& reading) override {
    sensor_->read(Forgetful(view), hits, rng, reading);
  }

 private:
  std::unique_ptr<Sensor> sensor_;
};

class RestlessPlugin : public Plugin {
 public:
  explicit RestlessPlugin(std::shared_ptr<const Plugin> plugin) : plugin_(std::move(plugin)) {}
  const Kind& kind() const override { return plugin_->kind(); }
  std::unique_ptr<Sensor> make_sensor(Params& params) const override {
    return std::make_unique<Restless>(plugin_->make_sensor(params));
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

const std::string kBall = "<sphere><radius>0.2</radius></sphere>";

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
                                             "librfid_reader.so",
                                             "libmicrophone.so",
                                             "libradio_receiver.so"};

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
  return simulation_of(text, 3, catalog());
}

void expect_made_at_each_due_time(const Snapshot& snapshot) {
  for (std::size_t i = 0; i < snapshot.sensors.size(); ++i) {
    const PublishedReading& published = snapshot.sensors[i];
    if (published.reading == nullptr) continue;
    EXPECT_EQ(published.reading->stamp, snapshot.stamp(i));
    EXPECT_EQ(published.lazy, nullptr);
  }
}

/// Both take the same ticks and commands and are compared at each tick.
struct Twins {
  std::unique_ptr<Simulation> skipping;
  std::unique_ptr<Simulation> eager;

  explicit Twins(const std::string& text = room())
      : skipping(make(text)), eager(make(restless(text))) {}

  void command(const Action& action, const Action& same) {
    skipping->post(action);
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
      expect_same_readings(*skipping->tick(), *eager->tick());
      expect_made_at_each_due_time(*eager->snapshot());
      if (::testing::Test::HasFailure()) return;
    }
  }
};

struct AtRest {
  int kept = 0;  // sensors whose reading is reused
  int lazy = 0;  // sensors whose lazy reading does
};

AtRest at_rest(const Snapshot& snapshot) {
  AtRest count;
  for (std::size_t i = 0; i < snapshot.sensors.size(); ++i) {
    const PublishedReading& published = snapshot.sensors[i];
    if (published.reading == nullptr || published.reading->stamp == snapshot.stamp(i)) continue;
    ++(published.lazy ? count.lazy : count.kept);
  }
  return count;
}

TEST(Watching, ReadingsAreThoseOfCastingAllRaysAtEachDueTime) {
  Twins twins;
  twins.run(6000);
  const AtRest rest = at_rest(*twins.skipping->snapshot());
  EXPECT_GT(rest.kept, 0);
  EXPECT_GT(rest.lazy, 2);
}

/// A household with sensors of what several kinds of devices report, and a transmitter.
std::string text_of_listeners() {
  const std::string first = "<sensor name='t'";
  const std::string stove = "<plugin name='h' filename='libheater.so'/>";
  return replaced(replaced(text_of_household(), first,
                           custom("mic", "microphone", "<threshold>40</threshold>") +
                               custom("radio", "radio_receiver", "") + first),
                  stove, stove + "<plugin name='r' filename='libradio_transmitter.so'/>");
}

TEST(Watching, AHouseholdIsReadAsAtEachDueTime) {
  Twins twins(text_of_listeners());
  twins.run(6000);
  for (const char* order : {"On", "Off"}) {
    twins.order("heater", "stove", order);
    twins.run(1500);
    twins.order("lamp", "hall0", order);
    twins.run(1500);
  }
  twins.order("person", "person", "Stop");
  twins.order("transmitter", "stove_transmitter", "Off");
  twins.order("door", "hall0", "Open");
  twins.run(4000);
  twins.order("person", "person", "Speak");
  twins.run(4000);
  EXPECT_GT(at_rest(*twins.skipping->snapshot()).lazy, 0);
}

TEST(Watching, LightAndContactsAreReadAsAtEachDueTime) {
  Twins twins(text_of_world());
  twins.order("lamp", "hall0", "On");
  twins.run(12000);
  twins.order("person", "person", "Stop");
  twins.run(8000);  // until the person counts as resting, which changes the light
  EXPECT_GT(at_rest(*twins.skipping->snapshot()).lazy, 4);
  twins.order("lamp", "hall0", "Dim 40");
  twins.run(2000);
  twins.order("door", "hall0", "Open");
  twins.run(4000);
  twins.order("lamp", "hall0", "Off");
  twins.run(2000);
}

/// A closed room with a lamp and a sensor, and a ball that falls outside.
std::string closed_room(const std::string& library) {
  const auto slab = [](const std::string& name, const std::string& size, const std::string& pose) {
    return body(name, "<box><size>" + size + "</size></box>", pose, true);
  };
  const std::string lux =
      "<sensor name='lux' type='camera'><pose>0.02 0 0 0 0 0</pose><update_rate>10</update_rate>"
      "<plugin name='l' filename='" +
      library + "'/></sensor>";
  return "<sdf version='1.6'><world name='w'>" + kLamp +
         slab("floor", "20 20 0.2", "0 0 -0.1 0 0 0") +
         slab("roof", "4.4 4.4 0.2", "0 0 2.7 0 0 0") +
         slab("north", "4.4 0.2 2.8", "0 2.1 1.3 0 0 0") +
         slab("south", "4.4 0.2 2.8", "0 -2.1 1.3 0 0 0") +
         slab("east", "0.2 4.4 2.8", "2.1 0 1.3 0 0 0") +
         slab("west", "0.2 4.4 2.8", "-2.1 0 1.3 0 0 0") +
         body("it", "<box><size>0.02 0.02 0.02</size></box>", "-1.9 0.5 1.5 0 0 0", true, lux) +
         body("outside", kBall, "6 0 0.6 0 0 0", false) + "</world></sdf>";
}

TEST(Watching, LightInAClosedRoomIsMeasuredAgainWhenSomethingMovesThere) {
  Twins twins(closed_room("libluminosity_sensor_controller.so"));
  twins.order("lamp", "hall0", "On");
  twins.run(300);
  ASSERT_GT(twins.skipping->snapshot()->counts.awake_bodies, 0U);
  EXPECT_EQ(at_rest(*twins.skipping->snapshot()).kept, 1);
  EXPECT_GT(twins.skipping->snapshot()->reading(0)->get<double>("illuminance"), 1.0);
  twins.run(3000);
  twins.spawn(body("inside", kBall, "0 0 0 0 0 0", false), {0.5, 0.3, 0.8});
  twins.run(3000);
  EXPECT_EQ(at_rest(*twins.skipping->snapshot()).kept, 1);
  for (const char* deleted : {"outside", "inside", "east"}) {
    twins.command(Delete{deleted}, Delete{deleted});
    twins.run(500);
  }
}

/// Measures light at two places: its own, and beyond the east wall.
class TwoPlaces : public Sensor {
 public:
  void configure(Params&, Wiring&) override {}
  void read(const View& view, Hits, Rng&, Reading& reading) override {
    const Pose beyond = view.pose() * Pose{Vec3(5.0, 0.0, 0.0), Quat::Identity()};
    reading.set("beyond", view.illuminance(probes_[0], beyond).illuminance);
    reading.set("here", view.illuminance(probes_[1], view.pose()).illuminance);
  }
  Nanoseconds idle_until(const Ahead&) const override { return kForever; }

 private:
  light::Probe probes_[2];
};

class TwoPlacesPlugin : public Plugin {
 public:
  const Kind& kind() const override {
    static const Kind kind("two_places", "Light at two places.");
    return kind;
  }
  std::unique_ptr<Sensor> make_sensor(Params&) const override {
    return std::make_unique<TwoPlaces>();
  }
};

TEST(Watching, LightAtASecondPlaceIsMeasuredAgainToo) {
  const auto plugin = std::make_shared<TwoPlacesPlugin>();
  catalog()->add("two_places", plugin);
  catalog()->add("restless_two_places", std::make_shared<RestlessPlugin>(plugin));
  const std::string sun =
      "<light name='sun' type='directional'><direction>-1 0 -1</direction></light></world>";
  const std::string text = replaced(closed_room("two_places"), "</world>", sun);
  Twins twins(text);
  twins.eager = make(replaced(text, "'two_places'", "'restless_two_places'"));
  twins.run(500);
  twins.spawn(body("passing", kBall, "0 0 0 0 0 0", false), {4.0, 0.5, 2.2});
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
  twins.spawn(body("screen", "<box><size>0.1 4 1</size></box>", "0 0 0 0 0 0", true), {-2, 0, 0.6});
  twins.run(1450);  // until between two publications of the gates
  for (const char* deleted : {"screen", "post", "wall", "drop", "brick"}) {
    twins.command(Delete{deleted}, Delete{deleted});
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

#include "plugin/params.h"

#include "angen_sim/fakes.h"
#include "document/xml.h"
#include "fuzz/targets.h"
#include "plugin/library.h"

namespace angen::fuzz {
namespace {

// Has whatever joint, link, light and collision a plug-in names.
class Anything : public test::FakeWorld {
 public:
  bool has_joint(const std::string&) const override { return true; }
  JointRef joint(const std::string& name) override { return {add(joints, name)}; }
  LinkRef link(const std::string& name) override { return {add(links, name)}; }
  LightRef light(const std::string& name) override { return {add(lights, name)}; }
  ContactRef collision(LinkRef, const std::string& name) override {
    collisions.push_back(name);
    return {static_cast<int>(collisions.size()) - 1};
  }

 private:
  template <class T>
  static int add(std::vector<std::pair<std::string, T>>& all, const std::string& name) {
    all.emplace_back(name, T{});
    return static_cast<int>(all.size()) - 1;
  }
};

using Plugins = std::vector<std::shared_ptr<const Plugin>>;

const Plugins& plugins() {
  static Catalog catalog;
  static const Plugins all = catalog.own();
  require(!all.empty(), "there are plug-ins");
  return all;
}

void sense(Sensor& sensor, Params& params, Anything& world) {
  sensor.configure(params, world);
  params.update_period();
  params.finish();
  require(sensor.sample_period() >= 0, "a period is not negative");
  for (int sample = 0; sample < 2; ++sample) {
    RayBatch rays;
    sensor.ray_set(world);
    sensor.aim(world, rays);
    const std::vector<rays::Hit> hits(rays.size());
    Rng rng(1, 2, sample);
    Reading reading;
    sensor.read(world, {hits.data(), hits.size()}, rng, reading);
    world.now += 100 * world.dt;
  }
}

void act(Device& device, Params& params, Anything& world) {
  device.configure(params, world);
  params.finish();
  for (int tick = 0; tick < 2; ++tick) {
    world.begin_tick();
    device.update(world, world);
    Reading state;
    device.report(world, state);
    world.now += world.dt;
  }
}

}  // namespace

void params(const std::string& input) {
  const Split given = split(input);
  const Plugin& plugin = *plugins()[given.choice % plugins().size()];
  answered([&] {
    const Element root = load::parse_xml(given.rest, "fuzz.sdf");
    const Element* inner = root.child("plugin");  // in a <sensor>
    Params params(inner != nullptr ? *inner : root, inner != nullptr ? &root : nullptr,
                  plugin.kind().rate());
    Anything world;
    if (const auto sensor = plugin.make_sensor(params)) return sense(*sensor, params, world);
    const auto device = plugin.make_device();
    if (device) act(*device, params, world);
  });
}

}  // namespace angen::fuzz

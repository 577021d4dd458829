#include "sim/simulation.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "sim/building.h"
#include "sim/command_queue.h"
#include "sim/device_system.h"
#include "sim/sensor_system.h"

namespace angen::sim {

namespace {

constexpr Nanoseconds kLongStep = kSecond / 50;

}  // namespace

struct Simulation::Impl {
  Impl(desc::World described, std::uint64_t seed_, std::shared_ptr<Catalog> catalog)
      : world(std::move(described)),
        seed(seed_),
        building(world, seed_, std::move(catalog)),
        devices(meter),
        sensors(seed_, requested, meter) {
    next.step = world.physics.step;
    next.seed = seed_;
    publish();
  }

  Clock clock() const { return {next.time, next.step}; }

  void drain() {
    const CommandQueue::Effects effects = commands.drain(building, clock(), next.events);
    if (effects.reset) sensors.due().invalidate();
    if (effects.commanded) devices.activate_all();
    if (effects.reset_time) {
      next.tick = 0;
      next.time = 0;
      next.counts.readings = 0;
    }
    for (const Faults::Move& move : building.faults().moves(next.time)) {
      building.displace(move.kind, move.name, move.by);
    }
    restructure();
    follow_placed();
    for (const std::shared_ptr<SavedState>& into : effects.saves) *into = saved();
  }

  // Sensors sample it in the next tick; snapshots show it also in a pause.
  void follow_placed() {
    for (LiveModel* live : building.take_placed()) {
      building.engines().note_change();
      building.note_moved(*live);
      if (!live->devices.empty()) building.forget_fields();
      sensors.due().note_moved(*live);
      for (std::uint32_t i = 0; i < live->parts.links.size(); ++i) {
        building.engines().follow(live->parts, i);
        write_link(*live, i);
        if (!commands.running()) next.moved_links.push_back(live->first_link + i);
      }
      write_joints(*live);
    }
  }

  // The present state: its numbers are those of the present structure.
  SavedState saved() {
    return {std::make_shared<const Snapshot>(next), building.saved_plugins(next.time, next.step),
            building.changed_models(), building.saved_lights()};
  }

  /// The tick that starts or ends at that time, or next after it.
  std::int64_t tick_of(Nanoseconds time) const {
    return (std::min(time, kForever - next.step) + next.step - 1) / next.step;
  }

  /// The end of the next tick, up to which time can pass at once: in a leap up to its start while
  /// nothing moves, in one step while only people and free leaves move. A device or a push needs a
  /// tick that starts at its time; a sensor, a fault, or a body that comes to rest, one that ends
  /// then.
  std::int64_t next_end(Nanoseconds until, bool long_steps) {
    const Engines& engines = building.engines();
    const bool moving = engines.physics.awake_count() > 0;
    const std::int64_t soonest = next.tick + 1;
    if (moving) {
      if (!long_steps) return soonest;
      const Nanoseconds longest = engines.physics.longest_step(kLongStep / next.step) * next.step;
      until = std::min(until, (next.time / longest + 1) * longest);
    }
    if (until / next.step <= soonest || (!moving && !next.events.empty())) return soonest;
    const std::int64_t end = std::min(
        {until / next.step, tick_of(engines.next_rest()), tick_of(building.faults().next()),
         tick_of(building.pushes().next(next.time)) + (moving ? 0 : 1)});
    const std::int64_t steps = std::min(end - next.tick, commands.ticks_to_go());
    if (steps <= 1) return soonest;
    return std::max(
        soonest,
        sensors.due().next_end(
            building, clock(),
            std::min(next.tick + steps, devices.next_end(building, clock(), moving)), moving));
  }

  /// Time passes without ticks.
  void skip_to(std::int64_t tick) {
    if (tick <= next.tick) return;
    sensors.due().skip_to(clock(), tick, next);
    next.tick = tick;
    next.time = tick * next.step;
    meter.rest.sensors += meter.watch.lap();
  }

  std::shared_ptr<const Snapshot> take_tick(Nanoseconds until, bool long_steps = false) {
    meter.watch.start(meter.on);
    drain();
    meter.rest.commands += meter.watch.lap();
    if (commands.running()) {
      const std::int64_t first = next.tick;
      const std::int64_t end = next_end(until, long_steps);
      if (building.engines().physics.awake_count() == 0) skip_to(end - 1);
      act();
      move(end);
      meter.rest.physics += meter.watch.lap();
      observe();
      commands.ticks_done(end - first);
      if (meter.on) meter.rest.simulated += (end - first) * next.step;
    }
    std::shared_ptr<const Snapshot> made = publish();
    meter.rest.snapshots += meter.watch.lap();
    commands.answer();
    return made;
  }

  void act() {
    devices.update(building, clock(), last_ticks * next.step, next.events);
    building.pushes().apply(building.engines(), next.time, next.step);
  }

  void move(std::int64_t end) {
    Engines& engines = building.engines();
    const bool was_awake = engines.physics.awake_count() > 0;
    const bool was_crowded = engines.physics.crowded();
    last_ticks = end - next.tick;
    skip_to(end - 1);
    engines.physics.step(next.tick, last_ticks);
    if (was_awake || !engines.physics.moved().empty()) engines.note_change();
    ++next.tick;
    for (const LiveModel* live : building.note_awake(next.tick)) {
      devices.note_awake(*live);
      sensors.due().note_moved(*live);
    }
    next.time = next.tick * next.step;
    for (const physics::Stopped& stopped : engines.physics.stopped()) note(stopped);
    if (engines.physics.crowded() && !was_crowded) note_crowd();
    for (const physics::LinkId link : building.engines().physics.moved()) {
      const Building::Owner owner = building.owner(link);
      building.note_moved(*owner.model);
      building.engines().follow(owner.model->parts, owner.link);
      write_link(*owner.model, owner.link);
      next.moved_links.push_back(owner.model->first_link + owner.link);
    }
    building.engines().note_rest(next.time);
  }

  void note(const physics::Stopped& stopped) {
    const Building::Owner owner = building.owner(stopped.link);
    const desc::Model& model = *owner.model->desc;
    next.events.push_back({next.time, model.name, "world", "stopped",
                           "link '" + model.links[owner.link].name + "' has been stopped: " +
                               stopped.why + "; reset the world or delete the model"});
  }

  void note_crowd() {
    next.events.push_back({next.time, "world", "world", "crowded",
                           "more contacts than can be solved: overlapping bodies pass through each "
                           "other until they are apart"});
  }

  void observe() {
    devices.report(building, clock(), next);
    sensors.sample(building, clock(), next.tick, next);
    if (devices.lights_changed()) write_lights();
  }

  std::shared_ptr<const Snapshot> publish() {
    restructure();
    next.paused = commands.paused();
    next.counts.awake_bodies = static_cast<std::uint32_t>(building.engines().physics.awake_count());
    next.counts.failed_steps = building.engines().physics.failed_steps();
    auto made = std::make_shared<Snapshot>(next);
    building.faults().pass(*made);
    next.moved_links.clear();
    next.new_readings.clear();
    next.new_states.clear();
    next.events.clear();
    const std::lock_guard<std::mutex> lock(latest_mutex);
    latest = made;
    return made;
  }

  Cost take_cost() {
    Cost cost = std::exchange(meter.rest, {});
    cost.structure = next.structure;
    for (LiveModel* live : building.with_devices()) {
      for (DeviceInstance& device : live->devices) {
        cost.each_device.push_back(std::exchange(device.cost, 0));
        cost.devices += cost.each_device.back();
      }
      for (SensorInstance& sensor : live->sensors) {
        cost.each_sensor.push_back(std::exchange(sensor.cost, 0));
        cost.sensors += cost.each_sensor.back();
      }
    }
    return cost;
  }

  // After an addition or a removal, later parts have new numbers, and are written again.
  void restructure() {
    if (next.structure && next.structure->revision == building.revision()) return;
    const std::size_t from = next.structure ? building.renumbered_from() : 0;
    const Numbering kept = building.numbering(from);
    next.structure = building.structure();
    building.faults().follow(next.structure, next.time);
    devices.invalidate();
    sensors.due().invalidate();
    next.link_poses.truncate(kept.link);
    next.joint_positions.truncate(kept.joint);
    next.devices.truncate(kept.device);
    next.limbs.truncate(kept.device);
    next.sensors.truncate(kept.sensor);
    next.moved_links.clear();
    for (std::size_t i = from; i < building.models().size(); ++i) append(*building.models()[i]);
    for (const LiveModel* live : building.with_devices()) {
      if (live->is_light) append_devices(*live);
    }
    write_lights();
    for (const std::string& warning : building.take_warnings()) {
      next.events.push_back({next.time, "world", "world", "warning", warning});
    }
  }

  void append(const LiveModel& live) {
    for (std::size_t i = 0; i < live.desc->links.size(); ++i) next.link_poses.push_back({});
    for (std::size_t i = 0; i < live.desc->joints.size(); ++i) next.joint_positions.push_back(0);
    for (std::uint32_t i = 0; i < live.desc->links.size(); ++i) write_link(live, i);
    write_joints(live);
    for (const SensorInstance& sensor : live.sensors) next.sensors.push_back(sensor.published);
    append_devices(live);
  }

  void append_devices(const LiveModel& live) {
    for (const DeviceInstance& device : live.devices) {
      next.devices.push_back(device.last);
      next.limbs.push_back(device.limbs);
    }
  }

  void write_link(const LiveModel& live, std::uint32_t link) {
    next.link_poses.set(live.first_link + link,
                        building.engines().physics.pose(live.parts.links[link]));
    for (const std::uint32_t joint : live.parts.child_joints[link]) write_joint(live, joint);
  }

  void write_joints(const LiveModel& live) {
    for (std::uint32_t i = 0; i < live.desc->joints.size(); ++i) write_joint(live, i);
  }

  void write_joint(const LiveModel& live, std::uint32_t joint) {
    next.joint_positions.set(live.first_joint + joint,
                             building.engines().physics.joint(live.parts.joints[joint]).position);
  }

  void write_lights() {
    next.light_levels = std::make_shared<const std::vector<double>>(building.light_levels());
  }

  std::int64_t last_ticks = 1;  // the length of the last tick
  desc::World world;
  std::uint64_t seed;
  Building building;
  CommandQueue commands;
  RequestedSensors requested;
  Meter meter;
  DeviceSystem devices;
  SensorSystem sensors;
  Snapshot next;
  mutable std::mutex latest_mutex;
  std::shared_ptr<const Snapshot> latest;
};

Simulation::Simulation(desc::World world, std::uint64_t seed, std::shared_ptr<Catalog> catalog)
    : impl_(std::make_unique<Impl>(std::move(world), seed, std::move(catalog))) {}

Simulation::~Simulation() = default;

std::future<Outcome> Simulation::post(Action action, std::shared_ptr<Ticket> ticket) {
  return impl_->commands.post(std::move(action), std::move(ticket));
}

std::shared_ptr<const Snapshot> Simulation::tick() { return impl_->take_tick(0); }

std::shared_ptr<const Snapshot> Simulation::leap(Nanoseconds until, bool long_steps) {
  return impl_->take_tick(until, long_steps);
}

void Simulation::look_ahead() { impl_->building.engines().look_ahead(impl_->next.time); }

std::shared_ptr<const Snapshot> Simulation::snapshot() const {
  const std::lock_guard<std::mutex> lock(impl_->latest_mutex);
  return impl_->latest;
}

void Simulation::request(const std::string& kind, const std::string& name, bool requested) {
  impl_->requested.set(kind, name, requested);
}

bool Simulation::requested(const std::string& kind, const std::string& name) const {
  return impl_->requested.has(kind, name);
}

void Simulation::observe(ActionObserver actions, RequestedSensors::Observer requests) {
  impl_->commands.observe(std::move(actions));
  impl_->requested.observe(std::move(requests));
}

void Simulation::accept_only_replay(std::string reason) {
  impl_->commands.accept_only_replay(std::move(reason));
}

void Simulation::end_replay() { impl_->commands.end_replay(); }

void Simulation::replay(std::vector<Action> actions) { impl_->commands.replay(std::move(actions)); }

void Simulation::measure(bool on) { impl_->meter.on = on; }

Cost Simulation::take_cost() { return impl_->take_cost(); }

SavedState Simulation::saved() { return impl_->saved(); }

Motion Simulation::motion(std::uint32_t link) const {
  const SharedArray<LinkEntry>& links = impl_->next.structure->links;
  if (link >= links.size()) throw Error("there is no link " + std::to_string(link));
  const LinkEntry& entry = links[link];
  return motion_of(impl_->building,
                   Entity{impl_->building.models().at(entry.model).get(), entry.link, {}, false});
}

Observed Simulation::observe(const Observation& what) const {
  Observed observed = sim::observe(impl_->building, what);
  observed.time = impl_->next.time;
  return observed;
}

std::vector<rays::Hit> Simulation::cast(const std::vector<rays::Ray>& rays) const {
  std::vector<rays::Hit> hits(rays.size());
  rays::Scene& scene = impl_->building.engines().rays;
  scene.commit();
  scene.cast(rays, hits);
  return hits;
}

bool Simulation::running() const { return impl_->commands.running(); }

const desc::World& Simulation::world() const { return impl_->world; }

std::uint64_t Simulation::seed() const { return impl_->seed; }

}  // namespace angen::sim

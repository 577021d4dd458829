#include "py/world.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <utility>

#include "core/limits.h"
#include "core/lists.h"
#include "core/text.h"
#include "core/typography.h"
#include "plugin/summary.h"

namespace angen::py {

namespace {

template <class Entry>
std::size_t index_of(const sim::SharedArray<Entry>& entries, const std::string& kind,
                     const std::string& name) {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].kind != kind) continue;
    if (entries[i].name == name) return i;
    known.push_back(entries[i].name);
  }
  throw Error("no " + printable(kind) + " named '" + printable(name) + "'; known are " +
              join_names(known));
}

template <class Entry>
World::Brief brief(const Entry& entry, const Reading* reading, Nanoseconds stamp) {
  const Kind& kind = entry.plugin->kind();
  if (reading == nullptr) return {entry.kind, entry.name, ""};
  return {entry.kind,
          entry.name,
          summary(kind, *reading),
          alarms(kind, *reading),
          to_seconds(stamp),
          numbers(kind, *reading)};
}

}  // namespace

World::World(const std::string& path, std::uint64_t seed, std::shared_ptr<Catalog> catalog,
             const std::string& log, bool allow_paths)
    : paths_(load::SearchPaths::from_environment(load::models_beside(path), allow_paths)),
      owned_(std::make_unique<sim::Simulation>(load::world(path, allow_paths), seed,
                                               std::move(catalog))),
      simulation_(*owned_) {
  if (!log.empty()) {
    recorder_ =
        std::make_unique<record::Recorder>(log, record::origin_of(path, allow_paths), simulation_);
  }
  note(simulation_.world().warnings, warnings_);
  note(simulation_.world().ignored, ignored_);
  note_warnings(*simulation_.snapshot());  // warnings of its construction
  begin();
}

World::World(const std::string& text, const std::string& name, std::uint64_t seed,
             std::shared_ptr<Catalog> catalog, bool allow_paths)
    : paths_(load::SearchPaths::from_environment("", allow_paths)),
      owned_(std::make_unique<sim::Simulation>(load::world_from_text(text, name, paths_), seed,
                                               std::move(catalog))),
      simulation_(*owned_) {
  note(simulation_.world().warnings, warnings_);
  note(simulation_.world().ignored, ignored_);
  note_warnings(*simulation_.snapshot());  // warnings of its construction
  begin();
}

World::World(std::unique_ptr<sim::Simulation> simulation, const std::string& models)
    : paths_(load::SearchPaths::from_environment(models)),
      owned_(std::move(simulation)),
      simulation_(*owned_) {
  begin();
}

void World::begin() {
  simulation_.post(sim::Pause{true});
  take(simulation_.tick());
  events_.clear();
}

void World::note(const std::vector<Diagnostic>& found, std::vector<std::string>& to) {
  for (const Diagnostic& each : found) note(each.text(), to);
}

/// Once: a model may be spawned any number of times.
void World::note(std::string text, std::vector<std::string>& to) {
  if (!is_in(text, to)) to.push_back(std::move(text));
}

void World::note_warnings(const sim::Snapshot& snapshot) {
  for (const sim::Event& event : snapshot.events) {
    if (event.event == "warning") note(event.detail, warnings_);
  }
}

void World::take(std::shared_ptr<const sim::Snapshot> snapshot) {
  if (readings_) readings_->add(*snapshot_, *snapshot);
  snapshot_ = std::move(snapshot);
  fingerprint_.add(*snapshot_);
  if (recorder_) {
    recorder_->add(*snapshot_);
    if (!recorder_->error().empty()) {
      failure_ = recorder_->error();
      recorder_.reset();
    }
  }
  events_.insert(events_.end(), snapshot_->events.begin(), snapshot_->events.end());
  note_warnings(*snapshot_);
  for (const sim::Event& event : snapshot_->events) {
    if (event.event == "failed" && failure_.empty()) {
      failure_ = event.kind + " '" + event.source + "' has failed: " + event.detail;
    }
  }
}

void World::raise_failure() {
  if (!failure_.empty()) throw Error(std::exchange(failure_, ""));
}

void World::require_open() const {
  if (closed_) throw Error("the world is closed: it can be read, and advances no more");
}

void World::close() {
  closed_ = true;
  recorder_.reset();
}

template <class Advance>
bool World::advance(std::uint64_t ticks, bool until_event, const Interrupts& interrupts,
                    Advance&& advance) {
  require_open();
  if (ticks == 0) return false;
  const auto ticket = std::make_shared<sim::Ticket>();
  const std::future<sim::Outcome> done = simulation_.post(sim::Step{ticks}, ticket);
  const std::int64_t last = snapshot_->tick + static_cast<std::int64_t>(ticks);
  bool stops = false;
  while (snapshot_->tick < last && !stops) {
    take(advance(last * snapshot_->step));
    stops = (until_event && !snapshot_->events.empty()) || interrupts.came();
  }
  if (stops) ticket->withdraw();
  raise_failure();
  return stops;
}

bool World::step(std::uint64_t ticks, const Interrupts& interrupts) {
  return advance(ticks, false, interrupts, [&](Nanoseconds) { return simulation_.tick(); });
}

bool World::run(std::uint64_t ticks, bool long_steps, bool until_event,
                const Interrupts& interrupts) {
  if (long_steps && recorder_) throw Error("long steps cannot be recorded: a replay has none");
  return advance(ticks, until_event, interrupts,
                 [&](Nanoseconds end) { return simulation_.leap(leap_limit(end), long_steps); });
}

Nanoseconds World::leap_limit(Nanoseconds until) const {
  return recorder_ ? std::min(until, recorder_->leap_limit(*snapshot_)) : until;
}

Nanoseconds duration(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0)
    throw Error("seconds must be finite and not negative");
  if (const std::string problem = limit_problem(limits::kTime, seconds); !problem.empty()) {
    throw Error("seconds are " + number_text(seconds) + "; " + problem);
  }
  return from_seconds(seconds);
}

std::uint64_t World::ticks_in(double seconds) const {
  return static_cast<std::uint64_t>(duration(seconds) / snapshot_->step);
}

// The world stays paused: a tick executes the actions that wait, and only step() moves time.
void World::drain(sim::Action action) {
  require_open();
  const Busy busy(*this);
  execute(std::move(action));
}

void World::execute(sim::Action action) {
  std::future<sim::Outcome> outcome = simulation_.post(std::move(action));
  take(simulation_.tick());
  const sim::Outcome result = outcome.get();
  if (!result.ok) throw Error(result.message);
}

void World::command(const std::string& kind, const std::string& name, const std::string& text,
                    const std::vector<double>& values) {
  drain(sim::ToDevice{kind, unquoted(name), {text, values}});
}

void World::spawn(const std::string& what, const std::string& name, const std::vector<double>& pose,
                  const std::string& on) {
  const bool is_sensor = load::is_sensor(what);
  if (!is_sensor && !on.empty()) {
    throw Error("only a <sensor> can be put on a link (on='" + printable(on) +
                "'), and this is a model");
  }
  if (is_sensor) {
    drain(sim::Attach{load::sensor(what, name, to_pose(pose)), on});
  } else {
    sim::Spawn spawn{load::model(what, name, to_pose(pose), paths_)};
    const std::vector<Diagnostic> ignored = spawn.model.ignored;
    drain(std::move(spawn));
    note(ignored, ignored_);
  }
}

void World::request(const std::string& kind, const std::string& name, bool wanted) {
  require_open();
  index_of(snapshot_->structure->sensors, kind, name);
  simulation_.request(kind, name, wanted);
}

void World::remove(const std::string& name) { drain(sim::Delete{name}); }

void World::edit(sim::Edit edit) { drain(std::move(edit)); }

sim::Motion World::motion(const std::string& entity) const {
  return simulation_.observe({{entity}, {}}).entities.front();
}

void World::reset() {
  require_open();
  const Busy busy(*this);
  execute(sim::Reset{});
  fingerprint_ = {};
  begin();
}

Reading World::sensor(const std::string& kind, const std::string& name) const {
  const sim::Structure& structure = *snapshot_->structure;
  const std::size_t index = index_of(structure.sensors, kind, name);
  const std::shared_ptr<const Reading> reading = snapshot_->reading(index);
  if (!reading) {
    const bool asleep = structure.sensors[index].on_demand() && !simulation_.requested(kind, name);
    throw Error(kind + " '" + name + "' has measured nothing yet; " +
                (asleep ? "request('" + kind + "', '" + name + "') and step first" : "step first"));
  }
  Reading copy = *reading;
  copy.stamp = snapshot_->stamp(index);
  return copy;
}

Reading World::device(const std::string& kind, const std::string& name) const {
  const auto& state = snapshot_->devices[index_of(snapshot_->structure->devices, kind, name)];
  if (!state) throw Error(kind + " '" + name + "' has reported nothing yet; step first");
  return *state;
}

std::string World::summary(const std::string& kind, const std::string& name) const {
  const sim::Structure& structure = *snapshot_->structure;
  for (std::size_t i = 0; i < structure.sensors.size(); ++i) {
    const sim::SensorEntry& entry = structure.sensors[i];
    if (entry.kind == kind && entry.name == name) return brief_sensor(i).text;
  }
  return brief_device(index_of(structure.devices, kind, name)).text;
}

World::Brief World::brief_sensor(std::size_t index) const {
  const sim::SensorEntry& entry = snapshot_->structure->sensors[index];
  const std::shared_ptr<const Reading> reading = snapshot_->reading(index);
  return brief(entry, reading.get(), reading ? snapshot_->stamp(index) : 0);
}

World::Brief World::brief_device(std::size_t index) const {
  const Reading* state = snapshot_->devices[index].get();
  return brief(snapshot_->structure->devices[index], state, state ? state->stamp : 0);
}

std::vector<World::Brief> World::summaries() const {
  std::vector<Brief> all;
  for (std::size_t i = 0; i < snapshot_->sensors.size(); ++i) all.push_back(brief_sensor(i));
  for (std::size_t i = 0; i < snapshot_->devices.size(); ++i) all.push_back(brief_device(i));
  return all;
}

std::string World::save() { return record::world_file(simulation_.world(), simulation_.saved()); }

ReadingLog& World::readings() {
  if (!readings_) throw Error("no readings are kept; call keep_readings() first");
  return *readings_;
}

std::string World::text() const {
  const sim::Structure& all = *snapshot_->structure;
  const auto count = [](std::size_t n, const std::string& what) {
    return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
  };
  return "<angen.World '" + printable(simulation_.world().name) + "' at " +
         number_text(to_seconds(snapshot_->time)) + " s: " + count(all.models.size(), "model") +
         ", " + count(all.devices.size(), "device") + ", " + count(all.sensors.size(), "sensor") +
         (closed_ ? ", closed>" : ">");
}

std::vector<sim::Event> World::take_events() { return std::exchange(events_, {}); }

}  // namespace angen::py

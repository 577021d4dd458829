#include "record/replay.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/files.h"
#include "record/recorder.h"

namespace angen::record {

namespace fs = std::filesystem;

namespace {

fs::path folder_of(const std::string& file) { return fs::absolute(file).parent_path(); }

std::string name_in(const std::string& uri) {
  return fs::path(uri.substr(uri.find("://") == std::string::npos ? 0 : uri.find("://") + 3))
      .filename()
      .string();
}

// A pose is checked in its text, which has it rounded.
bool is_near(const Pose& text, const Pose& exact) {
  constexpr double kNear = 1e-4;
  const auto& one = text.rotation.coeffs();
  const auto& other = exact.rotation.coeffs();
  return (text.position - exact.position).norm() < kNear &&
         ((one - other).norm() < kNear || (one + other).norm() < kNear);
}

// Logs come from others: the folder that one names is searched only where the world that it names
// is here, which would have it searched as well.
std::string models_beside_world(const LogHeader& header) {
  if (!is_plain_file(header.world)) return "";
  return fs::path(header.models) == load::models_beside(header.world) ? header.models : "";
}

}  // namespace

Replay::Replay(Log log, std::shared_ptr<Catalog> catalog, ReplaySettings settings)
    : log_(std::move(log)),
      settings_(settings),
      models_(models_beside_world(log_.header)),
      paths_(load::SearchPaths::from_environment(models_)) {
  const LogHeader& header = log_.header;
  const Located located = this->located(header.sdf, header.files, 1);
  desc::World world = load::world_from_text(located.sdf, log_.path, located.paths);
  simulation_ =
      std::make_unique<sim::Simulation>(std::move(world), header.seed, std::move(catalog));
  if (simulation_->snapshot()->step != header.step) {
    throw Error({log_.path, 1}, "its step is " + std::to_string(header.step) +
                                    " ns, that of its world " +
                                    std::to_string(simulation_->snapshot()->step) + " ns");
  }
  simulation_->accept_only_replay(log_.path + " is being replayed; commands are executed after it");
  note(*simulation_->snapshot());
}

void Replay::stop_at(Nanoseconds time) {
  const Nanoseconds step = log_.header.step;
  stop_ = (std::max<Nanoseconds>(time, 0) + step - 1) / step * step;
  compare(*simulation_->snapshot());
}

std::shared_ptr<const sim::Snapshot> Replay::advance(Nanoseconds until) {
  std::shared_ptr<const sim::Snapshot> here = simulation_->snapshot();
  while (settings_.requests && !at_end() && std::holds_alternative<ReadingRequest>(next().what)) {
    if (next().tick > here->tick) break;
    const auto& request = std::get<ReadingRequest>(log_.entries[at_++].what);
    simulation_->request(request.kind, request.name, request.wanted);
  }
  while (!settings_.requests && !at_end() && std::holds_alternative<ReadingRequest>(next().what))
    ++at_;
  if (at_end()) {
    compare(*here);
    return here;
  }
  std::shared_ptr<const sim::Snapshot> made;
  if (next().is_action() && next().tick == here->tick) {
    made = carry_out();
  } else if (next().tick <= here->tick || !simulation_->running()) {
    throw Error(source(next()),
                "belongs to tick " + std::to_string(next().tick) + ", but the replay " +
                    (simulation_->running() ? "is at tick " : "has ended at tick ") +
                    std::to_string(here->tick) + ": the log does not fit this build");
  } else if (settings_.leap) {
    until = std::min({until, next().tick * here->step, stop_.value_or(kForever)});
    made = simulation_->leap(until);
  } else {
    made = simulation_->tick();
  }
  note(*made);
  return made;
}

/// Executes all actions that were executed together, before one tick.
std::shared_ptr<const sim::Snapshot> Replay::carry_out() {
  const std::uint64_t batch = next().batch;
  std::vector<sim::Action> actions;
  for (; !at_end() && next().is_action() && next().batch == batch; ++at_) {
    actions.push_back(action_of(next()));
  }
  actions_ += actions.size();
  simulation_->replay(std::move(actions));
  return simulation_->tick();
}

sim::Action Replay::action_of(const LogEntry& entry) const {
  if (const auto* action = std::get_if<sim::Action>(&entry.what)) return *action;
  try {
    if (const auto* attach = std::get_if<AttachText>(&entry.what)) {
      return sim::Attach{load::sensor(attach->sdf, attach->name, attach->pose), attach->link};
    }
    const SpawnText& spawn = std::get<SpawnText>(entry.what);
    const Located located = this->located(spawn.sdf, spawn.files, entry.line);
    desc::World alone = load::world_from_text(located.sdf, "(text)", located.paths);
    if (alone.models.size() != 1) throw Error("is not one model");
    desc::Model model = std::move(alone.models.front());
    if (!is_near(model.pose, spawn.pose)) throw Error("its pose is not that of its text");
    model.pose = spawn.pose;
    return sim::Spawn{std::move(model)};
  } catch (const Error& error) {
    throw Error(source(entry), "cannot be replayed: " + std::string(error.what()));
  }
}

void Replay::note(const sim::Snapshot& snapshot) {
  fingerprint_.add(snapshot);
  compare(snapshot);
}

void Replay::compare(const sim::Snapshot& snapshot) {
  for (; !at_end() && std::holds_alternative<Check>(next().what) && next().tick == snapshot.tick;
       ++at_) {
    const std::string& recorded = std::get<Check>(next().what).fingerprint;
    if (recorded == fingerprint_.text()) {
      ++compared_;
    } else if (mismatch_.empty()) {
      const std::string host = this_host();
      mismatch_ =
          Diagnostic{Diagnostic::Severity::kError, source(next()),
                     "at " + std::to_string(to_seconds(snapshot.time)) + " s the fingerprint is " +
                         fingerprint_.text() + ", recorded was " + recorded +
                         (host == log_.header.host
                              ? ", on such a computer as this"
                              : "; recorded with " + log_.header.host + ", this is " + host)}
              .text();
    }
  }
  if (!at_end() && !(stop_ && snapshot.time >= *stop_)) return;
  done_ = true;
  simulation_->end_replay();
}

sim::Simulation& Replay::simulation() {
  if (!simulation_) throw Error("the world of this replay was taken from it");
  return *simulation_;
}

std::unique_ptr<sim::Simulation> Replay::take_simulation() {
  simulation();
  done_ = true;
  simulation_->end_replay();
  return std::move(simulation_);
}

/// The text, with files that are elsewhere now read from where they are: beside the log. One whose
/// contents the log knows may be read wherever it is.
Replay::Located Replay::located(const std::string& sdf, const std::vector<LogFile>& files,
                                int line) const {
  Located found{sdf, paths_};
  std::vector<load::UsedFile> moved;
  for (const load::UsedFile& used : load::files_of(sdf, paths_)) {
    const auto recorded = std::find_if(files.begin(), files.end(),
                                       [&](const LogFile& file) { return file.uri == used.uri; });
    if (recorded == files.end()) continue;
    if (recorded->hash == file_hash(used.path)) {
      found.paths.files.push_back(used.path);
      continue;
    }
    const std::string beside = (folder_of(log_.path) / name_in(used.uri)).string();
    if (recorded->hash != file_hash(beside)) {
      throw Error({log_.path, line},
                  "needs the file " + used.uri + " with the hash " + recorded->hash + "; " +
                      (used.path.empty() ? "it is missing" : used.path + " differs from it") +
                      ": put the file that was used beside the log, as " + beside);
    }
    moved.push_back({used.uri, beside});
    found.paths.files.push_back(beside);
  }
  if (!moved.empty()) found.sdf = load::with_files(sdf, moved);
  return found;
}

}  // namespace angen::record

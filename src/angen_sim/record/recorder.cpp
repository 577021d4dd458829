#include "record/recorder.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "core/files.h"
#include "core/random.h"
#include "document/xml.h"
#include "record/action_line.h"

namespace angen::record {

namespace fs = std::filesystem;

std::string file_hash(const std::string& path) {
  try {
    return fingerprint_text(hash_bytes(load::read_file(path)));
  } catch (const Error&) {
    return "";
  }
}

Origin origin_of(const std::string& world, bool allow_any) {
  const fs::path file = fs::absolute(world).lexically_normal();
  return {file.string(), load::world_text(world, allow_any), load::models_beside(file.string())};
}

Recorder::Recorder(std::string file, const Origin& origin, sim::Simulation& simulation)
    : path_(std::move(file)),
      simulation_(simulation),
      paths_(load::SearchPaths::from_environment(origin.models)) {
  file_ = open(path_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_APPEND | O_CLOEXEC, 0644);
  if (file_ < 0) {
    const std::string why =
        errno == EEXIST ? "exists already; record into another file" : std::strerror(errno);
    throw Error({path_, 0}, "cannot be written: " + why);
  }
  LogHeader header{this_version(), this_host(),   simulation.seed(),  simulation.snapshot()->step,
                   origin.world,   origin.models, hashed(origin.sdf), origin.sdf};
  LineWriter line;
  line.add("angen_log", kLogFormat);
  write_header(header, line);
  write(line);
  if (!error_.empty()) {
    close(file_);
    throw Error(error_);
  }
  fingerprint_.add(*simulation.snapshot());
  simulation.observe(
      [this](const sim::Action& action, Nanoseconds time) { this->action(action, time); },
      [this](const std::string& kind, const std::string& name, bool wanted) {
        const std::lock_guard<std::mutex> lock(mutex_);
        requests_.push_back({kind, name, wanted});
      });
}

Recorder::~Recorder() {
  simulation_.observe(nullptr, nullptr);
  write_fingerprint();  // fingerprint at the end
  close(file_);
}

void Recorder::action(const sim::Action& action, Nanoseconds time) {
  if (!error_.empty()) return;
  write_requests();
  if (sim::only_reads(action)) return;
  LineWriter line;
  line.add("tick", static_cast<std::uint64_t>(time / simulation_.snapshot()->step));
  line.add("batch", batch_);
  write_content(content_of(action), line);
  batch_used_ = true;
  write(line);
}

LogContent Recorder::content_of(const sim::Action& action) {
  if (const auto* spawn = std::get_if<sim::Spawn>(&action)) {
    std::string sdf = load::world_around(spawn->model);
    std::vector<LogFile> files = hashed(sdf);
    return SpawnText{spawn->model.name, spawn->model.pose, std::move(files), std::move(sdf)};
  }
  if (const auto* attach = std::get_if<sim::Attach>(&action)) {
    const desc::Sensor& sensor = attach->sensor;
    return AttachText{sensor.name, sensor.pose, attach->link, load::print_xml(sensor.element)};
  }
  return action;
}

void Recorder::add(const sim::Snapshot& snapshot) {
  fingerprint_.add(snapshot);
  write_requests();
  if (std::exchange(batch_used_, false)) ++batch_;
  tick_ = snapshot.tick;
  if (snapshot.time / kSecond == second_) return;
  second_ = snapshot.time / kSecond;
  write_fingerprint();
}

Nanoseconds Recorder::leap_limit(const sim::Snapshot& snapshot) const {
  const Nanoseconds second = (snapshot.time / kSecond + 1) * kSecond;
  return (second + snapshot.step - 1) / snapshot.step * snapshot.step;
}

void Recorder::write_requests() {
  std::vector<ReadingRequest> requests;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    requests.swap(requests_);
  }
  for (const ReadingRequest& request : requests) {
    LineWriter line;
    line.add("tick", static_cast<std::uint64_t>(tick_));
    write_content(request, line);
    write(line);
  }
}

void Recorder::write_fingerprint() {
  LineWriter line;
  line.add("tick", static_cast<std::uint64_t>(tick_));
  write_content(Check{fingerprint_.text()}, line);
  write(line);
}

// A line that does not fit on the disk is taken back, and ends the log.
void Recorder::write(LineWriter& line) {
  if (!error_.empty()) return;
  const std::string text = line.done(sum_);
  if (write_all(file_, text)) {
    written_ += text.size();
    return;
  }
  error_ = path_ + ": can no longer be written: " + std::strerror(errno) +
           "; the earlier actions can be replayed";
  if (ftruncate(file_, static_cast<off_t>(written_)) != 0) error_ += ", but for its last line";
}

std::vector<LogFile> Recorder::hashed(const std::string& sdf) {
  std::vector<LogFile> files;
  for (const load::UsedFile& used : load::files_of(sdf, paths_)) {
    std::error_code failed;
    const auto changed = fs::last_write_time(used.path, failed).time_since_epoch().count();
    const auto known = hashes_.find(used.path);
    if (known == hashes_.end() || known->second.changed != changed) {
      hashes_[used.path] = {changed, file_hash(used.path)};
    }
    files.push_back({used.uri, hashes_[used.path].hash});
  }
  return files;
}

}  // namespace angen::record

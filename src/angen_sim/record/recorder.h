#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "record/fingerprint.h"
#include "record/log.h"
#include "sdf/load.h"
#include "sim/simulation.h"

namespace angen::record {

class LineWriter;

/// The begin of a recording.
struct Origin {
  std::string world;  // the file's path
  std::string sdf;    // load::world_text
  std::string models;
};

/// The origin of a world's file; `allow_any` as in load::SearchPaths.
Origin origin_of(const std::string& world, bool allow_any = false);

/// Writes the log of a simulation, each line at once: however the process ends, all that was
/// executed before can be replayed. The simulation must not have ticked yet, and outlive this.
class Recorder {
 public:
  /// Throws Error if the file exists, or cannot be written.
  Recorder(std::string file, const Origin& origin, sim::Simulation& simulation);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Each snapshot after the first, in the thread that ticks.
  void add(const sim::Snapshot& snapshot);
  /// The limit of a leap from this snapshot: the next fingerprint.
  Nanoseconds leap_limit(const sim::Snapshot& snapshot) const;
  /// Why it does not write any more, empty while it does.
  const std::string& error() const { return error_; }

 private:
  void action(const sim::Action& action, Nanoseconds time);
  LogContent content_of(const sim::Action& action);
  void write_requests();
  void write_fingerprint();
  void write(LineWriter& line);
  std::vector<LogFile> hashed(const std::string& sdf);

  std::string path_;
  sim::Simulation& simulation_;
  load::SearchPaths paths_;
  int file_ = -1;
  std::uint64_t written_ = 0;  // bytes of whole lines
  std::uint64_t sum_ = 0;
  std::string error_;
  RunFingerprint fingerprint_;
  std::int64_t tick_ = 0;
  Nanoseconds second_ = 0;
  std::uint64_t batch_ = 0;
  bool batch_used_ = false;
  struct Hashed {
    std::int64_t changed;
    std::string hash;
  };
  std::map<std::string, Hashed> hashes_;  // by path
  std::mutex mutex_;                      // guards requests_
  std::vector<ReadingRequest> requests_;
};

/// The hash of a file that a log names; "" if it cannot be read.
std::string file_hash(const std::string& path);

}  // namespace angen::record

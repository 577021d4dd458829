#pragma once

#include <memory>
#include <optional>
#include <string>

#include "record/fingerprint.h"
#include "record/log.h"
#include "sdf/load.h"
#include "sim/simulation.h"

namespace angen::record {

struct ReplaySettings {
  bool leap = true;      // over ticks without a change; the fingerprints are the same
  bool requests = true;  // sensors sample on demand as they did; else the caller requests them
};

/// Runs a recorded simulation again and compares its fingerprints.
class Replay {
 public:
  /// Builds the world of the log. Throws Error: of a file that it needs and that is not there as it
  /// was, too.
  Replay(Log log, std::shared_ptr<Catalog> catalog, ReplaySettings settings = {});

  /// A tick, or a leap to `until` at most. Not after done(). Throws Error if an action of the
  /// log cannot take place.
  std::shared_ptr<const sim::Snapshot> advance(Nanoseconds until = kForever);
  /// Everything in the log has taken place, or the time of stop_at() is reached.
  bool done() const { return done_; }
  /// Ends the replay at this time; if the log's time starts again, at its first occurrence.
  void stop_at(Nanoseconds time);

  const Log& log() const { return log_; }
  /// The folder of models beside the log's world, where that is here; else empty.
  const std::string& models() const { return models_; }
  /// The simulation; from done() on it executes actions of others.
  sim::Simulation& simulation();
  std::unique_ptr<sim::Simulation> take_simulation();

  std::size_t actions() const { return actions_; }    // executed
  std::size_t compared() const { return compared_; }  // fingerprints that were equal
  /// The first fingerprint that differed, as file:line: text; empty while all are equal.
  const std::string& mismatch() const { return mismatch_; }

 private:
  const LogEntry& next() const { return log_.entries[at_]; }
  bool at_end() const { return at_ == log_.entries.size(); }
  Source source(const LogEntry& entry) const { return {log_.path, entry.line}; }
  std::shared_ptr<const sim::Snapshot> carry_out();
  sim::Action action_of(const LogEntry& entry) const;
  void compare(const sim::Snapshot& snapshot);
  void note(const sim::Snapshot& snapshot);
  struct Located {
    std::string sdf;
    load::SearchPaths paths;
  };
  Located located(const std::string& sdf, const std::vector<LogFile>& files, int line) const;

  Log log_;
  ReplaySettings settings_;
  std::string models_;
  load::SearchPaths paths_;
  std::unique_ptr<sim::Simulation> simulation_;
  RunFingerprint fingerprint_;
  std::size_t at_ = 0;
  std::optional<Nanoseconds> stop_;
  bool done_ = false;
  std::size_t actions_ = 0;
  std::size_t compared_ = 0;
  std::string mismatch_;
};

}  // namespace angen::record

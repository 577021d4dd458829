#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "core/diagnostics.h"
#include "core/pose.h"
#include "sim/command.h"

/// The log of a run: the input of a replay, line by line. docs/replay.md describes the format.
namespace angen::record {

constexpr std::uint64_t kLogFormat = 1;

/// A file that a world or a model is made of besides its text: a mesh or a picture.
struct LogFile {
  std::string uri;  // the URI in the text
  std::string hash;
};

struct LogHeader {
  std::string version;  // Angen's version
  std::string host;     // compiler, C library and processor, for a comparison
  std::uint64_t seed = 0;
  Nanoseconds step = 0;
  std::string world;   // the file's path
  std::string models;  // a folder that model:// is searched in
  std::vector<LogFile> files;
  std::string sdf;  // the world, includes written out
};

struct SpawnText {
  std::string name;
  Pose pose;  // to the bit; the text has it to 1e-12
  std::vector<LogFile> files;
  std::string sdf;  // a world with the model alone
};
struct AttachText {
  std::string name;
  Pose pose;
  std::string link;
  std::string sdf;
};
/// A sensor that samples on demand is requested, or no longer.
struct ReadingRequest {
  std::string kind;
  std::string name;
  bool wanted = true;
};
struct Check {
  std::string fingerprint;  // RunFingerprint up to this tick
};

using LogContent = std::variant<sim::Action, SpawnText, AttachText, ReadingRequest, Check>;

struct LogEntry {
  int line = 0;
  std::int64_t tick = 0;
  std::uint64_t batch = 0;  // actions of one number were executed together, before one tick
  LogContent what;

  bool is_action() const { return what.index() <= 2; }
};

struct Log {
  std::string path;
  LogHeader header;
  std::vector<LogEntry> entries;  // ticks ascend but for resets of the time
  std::string truncated;          // why lines after the last entry are missing, else empty
};

std::string this_version();
std::string this_host();

/// Throws Error, with the line, for a log of another version or one that is damaged. Only the last
/// line may be incomplete, as a process that was killed leaves it.
Log read_log(const std::string& path);

}  // namespace angen::record

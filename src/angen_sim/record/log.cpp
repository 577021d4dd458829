#include "record/log.h"

#include <gnu/libc-version.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <utility>

#include "document/xml.h"
#include "record/edit_line.h"
#include "sdf/load.h"

namespace angen::record {

namespace {

constexpr const char* kMark = "{\"angen_log\"";

// Its first line may be long where it is something else.
void check_begin(std::ifstream& stream, const std::string& path) {
  std::string begin(std::strlen(kMark), ' ');
  stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  if (stream.gcount() > 0 && begin != kMark) {
    throw Error({path, 1}, "is not a log of angen; it must begin with " + std::string(kMark));
  }
  stream.clear();
  stream.seekg(0);
}

// Pairs of address and hash.
void write_files(const std::vector<LogFile>& files, LineWriter& line) {
  std::vector<std::string> flat;
  for (const LogFile& file : files) {
    flat.push_back(file.uri);
    flat.push_back(file.hash);
  }
  line.texts("files", flat);
}

std::vector<LogFile> files_in(const LineReader& line) {
  const std::vector<std::string> flat = line.texts("files");
  if (flat.size() % 2 != 0) line.fail("'files' is not pairs of address and hash");
  std::vector<LogFile> files;
  for (std::size_t i = 0; i < flat.size(); i += 2) files.push_back({flat[i], flat[i + 1]});
  return files;
}

struct ActionWriter {
  const SpawnText& spawned;
  LineWriter& line;

  bool operator()(const sim::ToDevice& a) const {
    line.text("do", "command").text("kind", a.kind).text("name", a.name);
    line.text("text", a.command.text).numbers("values", a.command.values);
    line.text("verb", a.command.verb).number("number", a.command.number);
    return true;
  }
  bool operator()(const sim::Spawn& a) const {
    line.text("do", "spawn").text("name", a.model.name);
    line.numbers("pose", numbers_of(a.model.pose));
    write_files(spawned.files, line);
    line.text("sdf", spawned.sdf);
    return true;
  }
  bool operator()(const sim::Attach& a) const {
    line.text("do", "attach").text("name", a.sensor.name).text("on", a.link);
    line.numbers("pose", numbers_of(a.sensor.pose));
    line.text("sdf", load::print_xml(a.sensor.element));
    return true;
  }
  bool operator()(const sim::Delete& a) const {
    line.text("do", "delete").text("name", a.name);
    return true;
  }
  bool operator()(const sim::Pause& a) const {
    line.text("do", "pause").flag("paused", a.paused);
    return true;
  }
  bool operator()(const sim::Step& a) const {
    line.text("do", "step").whole("ticks", a.ticks);
    return true;
  }
  bool operator()(const sim::StopStep& a) const {
    line.text("do", "stop_step").whole("which", a.which);
    return true;
  }
  bool operator()(const sim::Reset& a) const {
    line.text("do", "reset").flag("with_time", a.with_time);
    return true;
  }
  bool operator()(const sim::Reject& a) const {
    line.text("do", "reject").text("source", a.source).text("kind", a.kind);
    line.text("reason", a.reason);
    return true;
  }
  bool operator()(const sim::Note& a) const {
    line.text("do", "note").text("source", a.source).text("kind", a.kind);
    line.text("event", a.event).text("detail", a.detail);
    return true;
  }
  bool operator()(const sim::Edit& a) const {
    write_edit(a, line);
    return true;
  }
  bool operator()(const sim::Save&) const { return false; }
  bool operator()(const sim::Observe&) const { return false; }
};

sim::ToDevice command_in(const LineReader& line) {
  return {line.text("kind"),
          line.text("name"),
          {line.text("text"), line.numbers("values"), line.text("verb"), line.number("number")}};
}

decltype(LogEntry::what) what_in(const LineReader& line) {
  const std::string what = line.text("do");
  const auto action = [](sim::Action a) { return a; };
  if (what == "command") return action(command_in(line));
  if (what == "spawn") {
    return SpawnText{line.text("name"), pose_in(line), files_in(line), line.text("sdf")};
  }
  if (what == "attach") {
    return AttachText{line.text("name"), pose_in(line), line.text("on"), line.text("sdf")};
  }
  if (what == "delete") return action(sim::Delete{line.text("name")});
  if (what == "pause") return action(sim::Pause{line.flag("paused")});
  if (what == "step") return action(sim::Step{line.whole("ticks")});
  if (what == "stop_step") return action(sim::StopStep{line.whole("which")});
  if (what == "reset") return action(sim::Reset{line.flag("with_time")});
  if (what == "reject") {
    return action(sim::Reject{line.text("source"), line.text("kind"), line.text("reason")});
  }
  if (what == "note") {
    return action(
        sim::Note{line.text("source"), line.text("kind"), line.text("event"), line.text("detail")});
  }
  if (what == "request")
    return ReadingRequest{line.text("kind"), line.text("name"), line.flag("wanted")};
  if (what == "fingerprint") return Check{line.text("hash")};
  if (std::optional<sim::Edit> edit = edit_in(what, line)) return action(std::move(*edit));
  line.fail("'" + what + "' is not something that a log does");
}

LogHeader header_in(const LineReader& line, const Source& at) {
  const std::uint64_t format = line.whole("angen_log");
  LogHeader header;
  header.version = line.text("version");
  if (format != kLogFormat || header.version != this_version()) {
    throw Error(at, "was recorded by angen " + header.version + " (format " +
                        std::to_string(format) + "), this is angen " + this_version() +
                        " (format " + std::to_string(kLogFormat) +
                        "); replay it with the version that recorded it");
  }
  header.host = line.text("host");
  header.seed = line.whole("seed");
  const std::uint64_t step = line.whole("step");
  if (step == 0 || step > static_cast<std::uint64_t>(kSecond))
    line.fail("'step' is not 1 ns to 1 s");
  header.step = static_cast<Nanoseconds>(step);
  header.world = line.text("world");
  header.models = line.text("models");
  header.files = files_in(line);
  header.sdf = line.text("sdf");
  return header;
}

LogEntry entry_in(const LineReader& line, int number, Nanoseconds step) {
  const std::uint64_t tick = line.whole("tick");
  if (tick > static_cast<std::uint64_t>(std::numeric_limits<Nanoseconds>::max() / step)) {
    line.fail("'tick' is later than time goes");
  }
  LogEntry entry{number, static_cast<std::int64_t>(tick), 0, what_in(line)};
  if (entry.is_action()) entry.batch = line.whole("batch");
  return entry;
}

}  // namespace

std::string this_version() { return ANGEN_VERSION; }

std::string this_host() {
  std::ifstream stream("/proc/cpuinfo");
  std::string processor = "an unknown processor";
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind("model name", 0) != 0 || line.find(": ") == std::string::npos) continue;
    processor = line.substr(line.find(": ") + 2);
    break;
  }
  return "compiler " __VERSION__ ", glibc " + std::string(gnu_get_libc_version()) + ", " +
         processor;
}

void write_header(const LogHeader& header, LineWriter& line) {
  line.whole("angen_log", kLogFormat).text("version", header.version).text("host", header.host);
  line.whole("seed", header.seed).whole("step", static_cast<std::uint64_t>(header.step));
  line.text("world", header.world).text("models", header.models);
  write_files(header.files, line);
  line.text("sdf", header.sdf);
}

bool write_action(const sim::Action& action, const SpawnText& spawned, LineWriter& line) {
  return std::visit(ActionWriter{spawned, line}, action);
}

Log read_log(const std::string& path) {
  std::error_code failed;
  const bool is_file = std::filesystem::is_regular_file(path, failed);  // others may not end
  std::ifstream stream(is_file ? path : "", std::ios::binary);
  if (!stream) throw Error({path, 0}, "cannot be read; give a log that record:= wrote");
  check_begin(stream, path);
  Log log{path, {}, {}, ""};
  std::uint64_t sum = 0;
  std::uint64_t byte = 0;
  int number = 0;
  std::uint64_t next_byte = 0;
  for (std::string line; std::getline(stream, line);) {
    byte = std::exchange(next_byte, next_byte + line.size() + 1);
    const Source at{path, ++number};
    if (stream.eof()) {  // without its line break
      if (number == 1) throw Error(at, "ends within its first line; nothing can be replayed");
      log.truncated = Diagnostic{Diagnostic::Severity::kWarning, at,
                                 "the line that begins at byte " + std::to_string(byte) +
                                     " is incomplete; replayed up to there"}
                          .text();
      break;
    }
    const LineReader reader(line, at, byte);
    if (number == 1) log.header = header_in(reader, at);
    reader.check(sum);
    if (number == 1) continue;
    log.entries.push_back(entry_in(reader, number, log.header.step));
    const std::int64_t last = log.entries.size() < 2 ? 0 : log.entries.end()[-2].tick;
    if (log.entries.back().tick - last > (kSecond + log.header.step - 1) / log.header.step) {
      reader.fail("'tick' is more than a second later than in the line before");
    }
  }
  if (number == 0) throw Error({path, 0}, "is empty; nothing can be replayed");
  return log;
}

}  // namespace angen::record

#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sim/snapshot.h"

namespace angen::py {

/// All that sensors publish, as rows of a long table: a row for each field of a reading, without
/// lists and images. Readings published in ticks that were leapt over are in it too.
class ReadingLog {
 public:
  /// A field of a sensor.
  struct Series {
    std::string kind, name, field, unit, type;
  };
  struct Rows {
    std::vector<double> time;                                // s
    std::vector<std::uint32_t> series;                       // index in series()
    std::vector<double> value;                               // a flag is 0 or 1; NaN of a text
    std::vector<std::pair<std::size_t, std::string>> texts;  // row, text or name of a choice
  };

  /// Adds the readings that were published after `before`, up to `now`.
  void add(const sim::Snapshot& before, const sim::Snapshot& now);
  const std::vector<Series>& series() const { return series_; }
  /// The rows since the last call.
  Rows take() { return std::exchange(rows_, {}); }

 private:
  using Fields = std::vector<std::pair<std::string, std::uint32_t>>;

  void add_skipped(const sim::Snapshot& before, Nanoseconds end);
  void add(const sim::SensorEntry& entry, const Reading& reading, Nanoseconds stamp);
  std::uint32_t series_of(Fields& known, const sim::SensorEntry& entry, const std::string& field);

  std::vector<Series> series_;
  std::unordered_map<std::string, Fields> known_;  // by kind/name
  Rows rows_;
};

}  // namespace angen::py

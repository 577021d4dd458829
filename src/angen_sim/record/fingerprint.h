#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/snapshot.h"

namespace angen::record {

/// 16 hexadecimal digits.
std::string fingerprint_text(std::uint64_t hash);

/// One number for a whole run, equal for a run that leaps and one that takes each tick, with any
/// subscribers and in any folder: it adds only ticks in which something changed, leaves out
/// sensors that sample on demand, and the texts of warnings and rejections, which name files.
class RunFingerprint {
 public:
  void add(const sim::Snapshot& snapshot);
  std::uint64_t value() const { return hash_; }
  std::string text() const { return fingerprint_text(hash_); }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
  std::shared_ptr<const sim::Structure> structure_;
  std::shared_ptr<const std::vector<double>> light_levels_;
};

/// A hash of all contents of snapshots: equal for runs with equal snapshots, bit for bit.
class Fingerprint {
 public:
  void add(const sim::Snapshot& snapshot);

  std::uint64_t value() const { return hash_; }
  std::string text() const { return fingerprint_text(hash_); }

 private:
  RunFingerprint run_;
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace angen::record

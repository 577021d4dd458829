#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/snapshot.h"

namespace angen::record {

/// One number for a whole run: equal for runs whose snapshots are equal, bit for bit.
class Fingerprint {
 public:
  /// Adds all that a snapshot holds: time, poses, joints, lights, what was read and what
  /// happened.
  void add(const sim::Snapshot& snapshot);

  std::uint64_t value() const { return hash_; }
  std::string text() const;  // 16 hexadecimal digits

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
  std::shared_ptr<const sim::Structure> structure_;
  std::shared_ptr<const std::vector<double>> light_levels_;
};

}  // namespace angen::record

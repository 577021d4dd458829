#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <unordered_map>

#include "plugin/reading.h"
#include "sim/mover_index.h"

namespace angen::sim {

/// When devices with which fields changed their states, of the fields by which sensors query
/// devices.
class StateChanges {
 public:
  using Moment = MoverIndex::Moment;
  using Fields = std::uint64_t;  // a bit a field

  /// The bit of a field; from now on changes of devices that have it are noted. The fields that
  /// come after many others share one bit, of all devices.
  Fields bit_of(const std::string& field) {
    const auto next = static_cast<unsigned>(std::min<std::size_t>(numbers_.size(), kAny));
    return Fields{1} << numbers_.try_emplace(field, next).first->second;
  }

  /// A device reports another state, with the same fields as before, or has moved.
  void note(const Reading& state, Moment now) {
    changed_[kAny] = std::max(changed_[kAny], now);
    for (const auto& [name, value] : state.fields) {
      const auto known = numbers_.find(name);
      if (known == numbers_.end()) continue;
      changed_[known->second] = std::max(changed_[known->second], now);
    }
  }

  /// A device came, went, or has other fields than before.
  void note_all(Moment now) {
    all_ = now;
    changed_[kAny] = std::max(changed_[kAny], now);
  }

  bool changed_since(Fields fields, Moment since) const {
    if (changed_[kAny] < since) return false;
    if (all_ >= since) return true;
    for (unsigned number = 0; fields != 0; ++number, fields >>= 1) {
      if ((fields & 1) != 0 && changed_[number] >= since) return true;
    }
    return false;
  }

 private:
  static constexpr unsigned kAny = 63;

  std::unordered_map<std::string, unsigned> numbers_;
  std::array<Moment, kAny + 1> changed_{};
  Moment all_ = 0;
};

}  // namespace angen::sim

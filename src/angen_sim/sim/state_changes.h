#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <unordered_map>

#include "plugin/reading.h"
#include "sim/mover_index.h"

namespace angen::sim {

/// The heights (m, world) at which devices matter to a query.
struct Heights {
  double low = std::numeric_limits<double>::infinity();  // above `high`: none
  double high = -std::numeric_limits<double>::infinity();

  Heights operator|(const Heights& o) const {
    return {std::min(low, o.low), std::max(high, o.high)};
  }
};

/// When devices with which fields changed their states, and at which heights, of the fields by
/// which sensors query devices.
class StateChanges {
 public:
  using Moment = MoverIndex::Moment;
  using Fields = std::uint64_t;  // a bit a field

  /// What is known of a device from its last change.
  class Device {
   private:
    friend class StateChanges;
    Fields fields = 0;      // the queried fields that it has
    std::size_t known = 0;  // how many fields were queried then
    int layer = 0;          // where it was
  };

  /// The bit of a field; from now on changes of devices that have it are noted. The fields that
  /// come after many others share one bit, of all devices.
  Fields bit_of(const std::string& field) {
    const auto next = static_cast<unsigned>(std::min<std::size_t>(numbers_.size(), kAny));
    return Fields{1} << numbers_.try_emplace(field, next).first->second;
  }

  /// A device at the height `z` reports another state, with the same fields as before, or has moved
  /// there.
  void note(const Reading& state, double z, Device& device, Moment now) {
    const bool is_first = device.known == 0;
    if (device.known != numbers_.size() + 1) list_fields(state, device);
    const int before = device.layer;
    device.layer = layer_of(z);
    note(device.fields, device.layer, now);
    if (!is_first && before != device.layer) note(device.fields, before, now);
  }

  /// A device came, went, or has other fields than before.
  void note_all(Moment now) {
    all_ = now;
    mark(changed_[kAny].latest, now);
  }

  bool changed_since(Fields fields, const Heights& within, Moment since) const {
    if (changed_[kAny].latest < since) return false;
    if (all_ >= since) return true;
    for (unsigned number = 0; fields != 0; ++number, fields >>= 1) {
      if ((fields & 1) != 0 && changed_since(changed_[number], within, since)) return true;
    }
    return false;
  }

 private:
  static constexpr unsigned kAny = 63;
  static constexpr double kLayer = 4.0;      // m
  static constexpr double kManyLayers = 16;  // more are not looked at one by one

  struct Changes {
    Moment latest = 0;
    std::unordered_map<int, Moment> layers;
  };

  static void mark(Moment& changed, Moment now) { changed = std::max(changed, now); }

  static int layer_of(double z) {
    return static_cast<int>(std::clamp(std::floor(z / kLayer), -1e9, 1e9));
  }

  void list_fields(const Reading& state, Device& device) {
    device.fields = Fields{1} << kAny;
    for (const auto& [name, value] : state.fields) {
      const auto number = numbers_.find(name);
      if (number != numbers_.end()) device.fields |= Fields{1} << number->second;
    }
    device.known = numbers_.size() + 1;
  }

  void note(Fields fields, int layer, Moment now) {
    for (unsigned number = 0; fields != 0; ++number, fields >>= 1) {
      if ((fields & 1) == 0) continue;
      mark(changed_[number].latest, now);
      mark(changed_[number].layers[layer], now);
    }
  }

  static bool changed_since(const Changes& changes, const Heights& within, Moment since) {
    if (changes.latest < since) return false;
    if (!(within.high - within.low < kManyLayers * kLayer)) return true;
    for (int layer = layer_of(within.low); layer <= layer_of(within.high); ++layer) {
      const auto at = changes.layers.find(layer);
      if (at != changes.layers.end() && at->second >= since) return true;
    }
    return false;
  }

  std::unordered_map<std::string, unsigned> numbers_;
  std::array<Changes, kAny + 1> changed_{};
  Moment all_ = 0;
};

}  // namespace angen::sim

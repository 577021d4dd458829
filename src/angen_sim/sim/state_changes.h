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

/// Heights (m, world) at which a device is, or at which devices matter to a query.
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

  struct Layers {
    int low = 0;
    int high = -1;  // below `low`: none

    bool operator!=(const Layers& o) const { return low != o.low || high != o.high; }
  };

  /// What is known of a device from its last change.
  class Device {
   private:
    friend class StateChanges;
    Fields fields = 0;      // the queried fields that it has
    std::size_t known = 0;  // how many fields were queried then
    Layers layers;          // where it was
  };

  /// The bit of a field; from now on changes of devices that have it are noted. The fields that
  /// come after many others share one bit, of all devices.
  Fields bit_of(const std::string& field) {
    const auto next = static_cast<unsigned>(std::min<std::size_t>(numbers_.size(), kAny));
    return Fields{1} << numbers_.try_emplace(field, next).first->second;
  }

  /// A device reports another state, with the same fields as before, or has moved; `where`: now.
  void note(const Reading& state, const Heights& where, Device& device, Moment now) {
    if (device.known != numbers_.size() + 1) list_fields(state, device);
    const Layers before = device.layers;
    device.layers = {layer_of(where.low), layer_of(where.high)};
    note(device.fields, device.layers, now);
    if (before != device.layers) note(device.fields, before, now);
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
  static constexpr double kLayer = 4.0;   // m
  static constexpr int kManyLayers = 16;  // more are not looked at one by one

  struct Changes {
    Moment latest = 0;
    Moment everywhere = 0;  // a device in many layers
    std::unordered_map<int, Moment> layers;
  };

  static void mark(Moment& changed, Moment now) { changed = std::max(changed, now); }

  static int layer_of(double z) {
    return static_cast<int>(std::clamp(std::floor(z / kLayer), -1e9, 1e9));
  }

  void list_fields(const Reading& state, Device& device) {
    device.fields = 0;
    for (const auto& [name, value] : state.fields) {
      const auto number = numbers_.find(name);
      if (number != numbers_.end() && number->second != kAny) {
        device.fields |= Fields{1} << number->second;
      }
    }
    device.known = numbers_.size() + 1;
  }

  void note(Fields fields, const Layers& at, Moment now) {
    mark(changed_[kAny].latest, now);
    mark(changed_[kAny].everywhere, now);
    for (unsigned number = 0; fields != 0; ++number, fields >>= 1) {
      if ((fields & 1) == 0) continue;
      Changes& changes = changed_[number];
      mark(changes.latest, now);
      if (at.high - at.low >= kManyLayers) {
        mark(changes.everywhere, now);
        continue;
      }
      for (int layer = at.low; layer <= at.high; ++layer) mark(changes.layers[layer], now);
    }
  }

  static bool changed_since(const Changes& changes, const Heights& within, Moment since) {
    if (changes.latest < since || within.low > within.high) return false;
    if (changes.everywhere >= since) return true;
    const Layers at{layer_of(within.low), layer_of(within.high)};
    if (at.high - at.low >= kManyLayers) return true;
    for (int layer = at.low; layer <= at.high; ++layer) {
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

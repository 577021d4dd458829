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

/// When devices changed their states, by the fields that sensors query and by height.
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

  /// What is known of a device from its last change.
  struct Device {
    Fields fields = 0;      // the queried fields that it has
    std::size_t known = 0;  // how many fields were queried then, and one
    Heights around;         // it has not left these since
  };

  /// A device `at` some heights reports another state, with the same fields as before, or has
  /// moved. Returns whether it has left the heights around those where it was.
  bool note(const Reading& state, const Heights& at, Device& device, Moment now) {
    if (device.known != numbers_.size() + 1) list_fields(state, device);
    const bool left = at.low < device.around.low || at.high > device.around.high;
    const Heights before = device.around;
    if (left) device.around = {at.low - kSlack, at.high + kSlack};
    const Heights both = before | device.around;
    for (Fields fields = device.fields; fields != 0; fields &= fields - 1) {
      Changes& changes = changed_[lowest_in(fields)];
      changes.latest = std::max(changes.latest, now);
      each_layer(both, [&](std::size_t layer) {
        changes.layers[layer] = std::max(changes.layers[layer], now);
        return true;
      });
    }
    return left;
  }

  /// A device came, went, or has other fields than before.
  void note_all(Moment now) {
    all_ = now;
    changed_[kAny].latest = std::max(changed_[kAny].latest, now);
  }

  bool changed_since(Fields fields, const Heights& within, Moment since) const {
    if (changed_[kAny].latest < since) return false;
    if (all_ >= since) return true;
    for (; fields != 0; fields &= fields - 1) {
      const Changes& changes = changed_[lowest_in(fields)];
      if (changes.latest < since) continue;
      const auto is_before = [&](std::size_t layer) { return changes.layers[layer] < since; };
      if (!each_layer(within, is_before)) return true;
    }
    return false;
  }

 private:
  static constexpr unsigned kAny = 63;
  static constexpr double kSlack = 0.5;  // m, more than a walker's ups and downs
  // Layers are 1 m high; one that is this many higher counts as the same.
  static constexpr std::size_t kLayers = 128;

  struct Changes {
    Moment latest = 0;
    std::array<Moment, kLayers> layers{};
  };

  static unsigned lowest_in(Fields fields) {
    return static_cast<unsigned>(__builtin_ctzll(fields));
  }

  void list_fields(const Reading& state, Device& device) {
    device.fields = Fields{1} << kAny;
    for (const auto& [name, value] : state.fields) {
      const auto number = numbers_.find(name);
      if (number != numbers_.end()) device.fields |= Fields{1} << number->second;
    }
    device.known = numbers_.size() + 1;
  }

  /// Whether visit(layer) is true for each layer at these heights; ends with the first that is not.
  template <class F>
  static bool each_layer(const Heights& at, F&& visit) {
    if (!(at.low <= at.high)) return true;
    const auto layer_of = [](double z) {
      return static_cast<std::int64_t>(std::floor(std::clamp(z, -1e9, 1e9)));
    };
    const std::int64_t first = layer_of(at.low);
    const auto end = std::min(layer_of(at.high) + 1, first + static_cast<std::int64_t>(kLayers));
    for (std::int64_t layer = first; layer < end; ++layer) {
      if (!visit(static_cast<std::size_t>(layer) % kLayers)) return false;
    }
    return true;
  }

  std::unordered_map<std::string, unsigned> numbers_;
  std::array<Changes, kAny + 1> changed_{};
  Moment all_ = 0;
};

}  // namespace angen::sim

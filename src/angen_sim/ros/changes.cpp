#include "ros/changes.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <unordered_map>

namespace angen::node {
namespace {

Numbers unrelated(std::size_t before, std::size_t now) {
  return {std::vector<std::uint32_t>(now, Numbers::kNone),
          std::vector<std::uint32_t>(before, Numbers::kNone)};
}

void relate(Numbers& numbers, std::uint32_t before, std::uint32_t now) {
  numbers.before[now] = before;
  numbers.after[before] = now;
}

/// An entry's description, and a number that distinguishes entries of one description. Both
/// structures are there, so an address is that of one description.
struct Identity {
  const void* description;
  std::uint64_t number;

  bool operator==(const Identity& o) const {
    return description == o.description && number == o.number;
  }
};

struct Hash {
  std::size_t operator()(const Identity& identity) const {
    return std::hash<const void*>()(identity.description) ^ identity.number;
  }
};

Identity identity(const std::shared_ptr<const desc::Model>& model) { return {model.get(), 0}; }
Identity identity(const sim::SensorEntry& sensor) { return {sensor.desc.get(), sensor.key}; }

template <class Entries>
Numbers by_identity(const Entries& before, const Entries& now) {
  Numbers numbers = unrelated(before.size(), now.size());
  std::uint32_t same = 0;  // at the front, where most is
  const std::size_t shorter = std::min(before.size(), now.size());
  for (; same < shorter && identity(before[same]) == identity(now[same]); ++same) {
    relate(numbers, same, same);
  }
  std::unordered_map<Identity, std::uint32_t, Hash> known;
  for (std::uint32_t i = same; i < before.size(); ++i) known.emplace(identity(before[i]), i);
  for (std::uint32_t i = same; i < now.size(); ++i) {
    const auto found = known.find(identity(now[i]));
    if (found == known.end()) continue;
    relate(numbers, found->second, i);
    known.erase(found);
  }
  return numbers;
}

/// The first entry of each model; entries of a model are adjacent.
template <class Entry>
std::vector<std::uint32_t> firsts(const sim::SharedArray<Entry>& entries, std::size_t models) {
  std::vector<std::uint32_t> first(models, 0);
  for (std::size_t i = entries.size(); i-- > 0;) {
    if (entries[i].model < models) first[entries[i].model] = static_cast<std::uint32_t>(i);
  }
  return first;
}

/// A model's entries do not change while its description stays.
template <class Entry>
Numbers by_model(const Numbers& models, const sim::SharedArray<Entry>& before,
                 const sim::SharedArray<Entry>& now) {
  Numbers numbers = unrelated(before.size(), now.size());
  const std::vector<std::uint32_t> first_before = firsts(before, models.after.size());
  const std::vector<std::uint32_t> first_now = firsts(now, models.before.size());
  for (std::uint32_t i = 0; i < now.size(); ++i) {
    const std::uint32_t model = now[i].model;
    if (model == UINT32_MAX || models.before[model] == Numbers::kNone) continue;
    relate(numbers, first_before[models.before[model]] + i - first_now[model], i);
  }
  return numbers;
}

/// Lights of the world's own, which are before all others.
void relate_own(Numbers& numbers, const sim::SharedArray<sim::LightEntry>& before,
                const sim::SharedArray<sim::LightEntry>& now) {
  const auto is_own = [](const sim::LightEntry& light) { return light.model == UINT32_MAX; };
  std::uint32_t at = 0;
  for (std::uint32_t i = 0; i < now.size() && is_own(now[i]); ++i) {
    for (std::uint32_t j = at; j < before.size() && is_own(before[j]); ++j) {
      if (!(before[j].light == now[i].light)) continue;
      relate(numbers, j, i);
      at = j + 1;
      break;
    }
  }
}

}  // namespace

Changes changes_between(const sim::Structure* before, const sim::Structure& now) {
  static const sim::Structure nothing;
  if (before == nullptr) before = &nothing;
  Changes changes;
  changes.models = by_identity(before->models, now.models);
  changes.links = by_model(changes.models, before->links, now.links);
  changes.devices = by_model(changes.models, before->devices, now.devices);
  changes.lights = by_model(changes.models, before->lights, now.lights);
  relate_own(changes.lights, before->lights, now.lights);
  changes.sensors = by_identity(before->sensors, now.sensors);
  for (std::uint32_t i = 0; i < now.sensors.size(); ++i) {
    std::uint32_t& sensor = changes.sensors.before[i];
    const bool stays = changes.models.before[now.sensors[i].model] != Numbers::kNone;
    if (sensor == Numbers::kNone || stays) continue;
    changes.sensors.after[sensor] = Numbers::kNone;
    sensor = Numbers::kNone;
  }
  return changes;
}

}  // namespace angen::node

#include "py/reading_log.h"

#include <limits>
#include <optional>

namespace angen::py {

namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

struct Cell {
  double value = kNoNumber;
  std::string text;
};

/// None of a list or an image.
std::optional<Cell> cell_of(const Value& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return Cell{*flag ? 1.0 : 0.0, {}};
  if (const auto* integer = std::get_if<std::int64_t>(&value)) {
    return Cell{static_cast<double>(*integer), {}};
  }
  if (const auto* number = std::get_if<double>(&value)) return Cell{*number, {}};
  if (const auto* text = std::get_if<std::string>(&value)) return Cell{kNoNumber, *text};
  if (const auto* choice = std::get_if<Choice>(&value)) {
    return Cell{static_cast<double>(choice->value), choice->name};
  }
  return std::nullopt;
}

/// The tick of publication number `count` of a sensor that publishes at each due time.
Nanoseconds publication(const sim::Schedule& schedule, std::int64_t count) {
  const Nanoseconds due = count * std::max(schedule.sample, schedule.publish);
  const Nanoseconds samples = (due + schedule.sample - 1) / schedule.sample;
  return schedule.tick_of(schedule.start + samples * schedule.sample);
}

}  // namespace

void ReadingLog::add(const sim::Snapshot& before, const sim::Snapshot& now) {
  if (now.tick > before.tick + 1) add_skipped(before, now.time);
  for (const std::uint32_t sensor : now.new_readings) {
    if (const auto reading = now.reading(sensor)) {
      add(now.structure->sensors[sensor], *reading, now.stamp(sensor));
    }
  }
}

void ReadingLog::add_skipped(const sim::Snapshot& before, Nanoseconds end) {
  sim::Snapshot then = before;
  for (std::size_t i = 0; i < before.sensors.size(); ++i) {
    const sim::SensorEntry& entry = before.structure->sensors[i];
    if (entry.on_demand() || before.sensors[i].reading == nullptr) continue;
    for (std::int64_t k = entry.schedule.publications(before.time);; ++k) {
      then.time = publication(entry.schedule, k);
      if (then.time >= end) break;
      add(entry, *then.reading(i), then.time);
    }
  }
}

void ReadingLog::add(const sim::SensorEntry& entry, const Reading& reading, Nanoseconds stamp) {
  Fields& known = known_[sim::full_name(entry)];
  for (const auto& [name, value] : reading.fields) {
    std::optional<Cell> cell = cell_of(value);
    if (!cell) continue;
    if (!cell->text.empty()) rows_.texts.emplace_back(rows_.time.size(), std::move(cell->text));
    rows_.time.push_back(to_seconds(stamp));
    rows_.series.push_back(series_of(known, entry, name));
    rows_.value.push_back(cell->value);
  }
}

std::uint32_t ReadingLog::series_of(Fields& known, const sim::SensorEntry& entry,
                                    const std::string& field) {
  for (const auto& [name, index] : known) {
    if (name == field) return index;
  }
  Series series{entry.kind, entry.name, field, "", ""};
  for (const Field& each : entry.plugin->kind().fields) {
    if (each.name != field) continue;
    series.unit = each.unit;
    series.type = name_of(each.type);
  }
  known.emplace_back(field, static_cast<std::uint32_t>(series_.size()));
  series_.push_back(std::move(series));
  return known.back().second;
}

}  // namespace angen::py

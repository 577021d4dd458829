#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/time.h"

namespace angen {

/// An image: height x width x channels values, row after row from the top. Copies share them.
template <class T>
struct Grid {
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::uint32_t channels = 0;
  std::shared_ptr<const std::vector<T>> values;

  bool operator==(const Grid& other) const {
    return height == other.height && width == other.width && channels == other.channels &&
           (values == other.values || (values && other.values && *values == *other.values));
  }
};
using ByteGrid = Grid<std::uint8_t>;
using FloatGrid = Grid<float>;

using Value = std::variant<bool, std::int64_t, double, std::string, std::vector<double>,
                           std::vector<std::string>, ByteGrid, FloatGrid>;

/// What a sensor measured or the state a device is in: named values. `ros` knows the built-in kinds
/// and sends any other as a generic message.
struct Reading {
  std::string kind;       // "pir", "door", …
  Nanoseconds stamp = 0;  // when it was made; it stands until another is
  std::vector<std::pair<std::string, Value>> fields;
  bool urgent = false;  // a sensor sets it to have this reading sent before its period is over
  std::string event;    // set when something worth an event happened: "motion", "opened"
  std::string event_detail;

  template <class T>
  void set(const char* name, T value) {
    for (auto& [key, old] : fields) {
      if (key == name) {
        old = Value(std::move(value));
        return;
      }
    }
    fields.emplace_back(name, Value(std::move(value)));
  }
  void set(const char* name, int value) { set(name, static_cast<std::int64_t>(value)); }
  void set(const char* name, const char* value) { set(name, std::string(value)); }

  const Value* find(const std::string& name) const {
    for (const auto& [key, value] : fields) {
      if (key == name) return &value;
    }
    return nullptr;
  }
  /// The field's value, or `fallback` where it is missing or of another type.
  template <class T>
  T get(const std::string& name, T fallback = T{}) const {
    const Value* value = find(name);
    const T* typed = value != nullptr ? std::get_if<T>(value) : nullptr;
    return typed != nullptr ? *typed : fallback;
  }
  bool same_names(const Reading& other) const {
    return std::equal(fields.begin(), fields.end(), other.fields.begin(), other.fields.end(),
                      [](const auto& a, const auto& b) { return a.first == b.first; });
  }
  bool same_values(const Reading& other) const {
    return kind == other.kind && fields == other.fields;
  }
};

}  // namespace angen

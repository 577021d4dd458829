#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/time.h"

namespace angen {

/// An image: height x width x channels values, row after row from the top. Copies share them.
template <class T>
struct ImageArray {
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::uint32_t channels = 0;
  std::shared_ptr<const std::vector<T>> values;

  bool operator==(const ImageArray& other) const {
    return height == other.height && width == other.width && channels == other.channels &&
           (values == other.values || (values && other.values && *values == *other.values));
  }
};
using ByteImage = ImageArray<std::uint8_t>;
using FloatImage = ImageArray<float>;

/// One of a few named values, as a door's mode. Its name lives as long as the process: a literal.
struct Choice {
  std::int64_t value = 0;  // the constant that messages have for it
  const char* name = "";   // "OPEN"

  bool operator==(const Choice& other) const { return value == other.value; }
};

/// The choice that an enumerator is, by the names of all of them.
template <class Enum, std::size_t N>
Choice choice_of(Enum value, const char* const (&names)[N]) {
  const auto index = static_cast<std::size_t>(value);
  return {static_cast<std::int64_t>(index), names[index]};
}

using Value = std::variant<bool, std::int64_t, double, std::string, std::vector<double>,
                           std::vector<std::string>, ByteImage, FloatImage, Choice>;

/// The field of a reading or state whose plug-in threw an exception and is called no more: which.
inline constexpr const char* kErrorField = "error";

/// Values that a sensor measured, or the state of a device, by name. A kind without a message of
/// its own is published as the generic angen_msgs/Reading.
struct Reading {
  std::string kind;       // "pir", "door", …
  Nanoseconds stamp = 0;  // when it was made; it is valid until the next
  std::vector<std::pair<std::string, Value>> fields;
  bool urgent = false;  // a sensor sets it to have this reading sent before its period is over
  std::string event;    // set when something worth an event happened: "motion", "opened"
  std::string event_detail;

  /// Has it sent at once, with that event.
  void announce(std::string what, std::string detail = "") {
    urgent = true;
    event = std::move(what);
    event_detail = std::move(detail);
  }

  template <class T>
  void set(const char* name, T value) {
    for (auto& [key, old] : fields) {
      if (key != name) continue;
      if constexpr (std::is_same_v<T, std::int64_t>) {
        if (auto* number = std::get_if<double>(&old)) {  // a number stays one
          *number = static_cast<double>(value);
          return;
        }
      }
      old = Value(std::move(value));
      return;
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
  /// The field's value; of a choice its name, of an integer also the number. Throws Error if it
  /// is missing, as all may be where the plug-in has failed, or of another type.
  template <class T>
  T get(const std::string& name) const {
    const Value* value = find(name);
    if (value == nullptr) throw_missing(name);
    return value_as<T>(name, *value);
  }
  /// The field's value, or `fallback` if it is missing.
  template <class T>
  T get(const std::string& name, T fallback) const {
    const Value* value = find(name);
    return value != nullptr ? value_as<T>(name, *value) : fallback;
  }
  /// The field's value where it has one of this type, as in states of devices of any kind.
  template <class T>
  const T* get_if(const std::string& name) const {
    const Value* value = find(name);
    return value != nullptr ? std::get_if<T>(value) : nullptr;
  }
  bool same_names(const Reading& other) const {
    return std::equal(fields.begin(), fields.end(), other.fields.begin(), other.fields.end(),
                      [](const auto& a, const auto& b) { return a.first == b.first; });
  }
  bool same_values(const Reading& other) const {
    return kind == other.kind && fields == other.fields;
  }

 private:
  template <class T>
  T value_as(const std::string& name, const Value& value) const {
    if (const T* typed = std::get_if<T>(&value)) return *typed;
    if constexpr (std::is_same_v<T, std::string>) {
      if (const auto* choice = std::get_if<Choice>(&value)) return choice->name;
    }
    if constexpr (std::is_same_v<T, double>) {
      if (const auto* integer = std::get_if<std::int64_t>(&value)) return double(*integer);
    }
    throw_type(name, value, Value(T{}));
  }
  [[noreturn]] void throw_missing(const std::string& name) const;
  [[noreturn]] void throw_type(const std::string& name, const Value& value,
                               const Value& read_as) const;
};

/// "number", "text", …: the type's name in descriptions of kinds.
const char* type_name(const Value& value);

/// States of devices that had no event are published at its multiples.
constexpr Nanoseconds kReportPeriod = kSecond / 50;

}  // namespace angen

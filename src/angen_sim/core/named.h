#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// Lists whose entries, or the objects that these point to, have a `name`.
namespace angen {

template <class Entry>
auto name_in(const Entry& entry) -> decltype((entry.name)) {
  return entry.name;
}
template <class Entry>
auto name_in(const Entry& entry) -> decltype((entry->name)) {
  return entry->name;
}

template <class Entries>
std::vector<std::string> names_in(const Entries& entries) {
  std::vector<std::string> names;
  names.reserve(entries.size());
  for (const auto& entry : entries) names.emplace_back(name_in(entry));
  return names;
}

/// The index of the first entry of that name; none if there is none.
template <class Entries>
std::optional<std::uint32_t> index_in(const Entries& entries, const std::string& name) {
  std::uint32_t index = 0;
  for (const auto& entry : entries) {
    if (name_in(entry) == name) return index;
    ++index;
  }
  return std::nullopt;
}

}  // namespace angen

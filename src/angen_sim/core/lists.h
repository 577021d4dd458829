#pragma once

#include <algorithm>
#include <iterator>

namespace angen {

/// Whether a list has an equal entry.
template <class Value, class List>
bool is_in(const Value& value, const List& list) {
  return std::find(std::begin(list), std::end(list), value) != std::end(list);
}

/// Removes the entries for which `matches` is true; others keep their order.
template <class List, class Matches>
void erase_if(List& list, Matches&& matches) {
  list.erase(std::remove_if(list.begin(), list.end(), matches), list.end());
}

/// Sorts a list, and keeps each entry once.
template <class List>
void sort_unique(List& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace angen

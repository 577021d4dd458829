#pragma once

#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/id.h"

namespace angen {

/// Values addressed by generational ids, iterated in index order (the order decides no result by
/// chance).
template <class T, class Tag>
class Slots {
 public:
  using Key = Id<Tag>;

  Key add(T value) {
    if (free_.empty()) {
      slots_.push_back({std::move(value), 0});
      return {static_cast<std::uint32_t>(slots_.size() - 1), 0};
    }
    const std::uint32_t index = free_.back();
    free_.pop_back();
    slots_[index].value = std::move(value);
    return {index, slots_[index].generation};
  }

  void remove(Key key) {
    at(key);
    slots_[key.index].value.reset();
    ++slots_[key.index].generation;
    free_.push_back(key.index);
  }

  bool contains(Key key) const {
    return key.index < slots_.size() && slots_[key.index].generation == key.generation &&
           slots_[key.index].value.has_value();
  }

  /// Throws std::out_of_range for an id that was removed or never given.
  T& at(Key key) {
    if (!contains(key)) throw std::out_of_range("stale id");
    return *slots_[key.index].value;
  }
  const T& at(Key key) const { return const_cast<Slots*>(this)->at(key); }

  template <class F>
  void each(F&& visit) {
    for (std::uint32_t i = 0; i < slots_.size(); ++i) {
      if (slots_[i].value) visit(Key{i, slots_[i].generation}, *slots_[i].value);
    }
  }
  template <class F>
  void each(F&& visit) const {
    const_cast<Slots*>(this)->each([&](Key key, T& value) { visit(key, std::as_const(value)); });
  }

  std::size_t size() const { return slots_.size() - free_.size(); }

 private:
  struct Slot {
    std::optional<T> value;
    std::uint32_t generation;
  };
  std::vector<Slot> slots_;
  std::vector<std::uint32_t> free_;
};

}  // namespace angen

#pragma once

#include <iterator>
#include <map>
#include <memory>
#include <mutex>

namespace angen {

/// Objects that are in use, by key. Any thread.
template <class Key, class T>
class Kept {
 public:
  /// The object of a key; `make` returns a pointer to a new one if none is in use.
  template <class Make>
  std::shared_ptr<T> get(const Key& key, const Make& make) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      for (auto it = all_.begin(); it != all_.end();) {
        it = it->second.expired() ? all_.erase(it) : std::next(it);
      }
      const auto found = all_.find(key);
      if (found != all_.end()) {
        if (auto kept = found->second.lock()) return kept;
      }
    }
    std::shared_ptr<T> made = make();
    const std::lock_guard<std::mutex> lock(mutex_);
    if (auto meanwhile = all_[key].lock()) return meanwhile;
    all_[key] = made;
    return made;
  }

 private:
  std::mutex mutex_;
  std::map<Key, std::weak_ptr<T>> all_;
};

}  // namespace angen

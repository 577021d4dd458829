#pragma once

#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <utility>

namespace angen::sim {

/// The requested ones of the sensors that sample on demand only. By kind
/// and name; any thread.
class RequestedSensors {
 public:
  using Observer = std::function<void(const std::string&, const std::string&, bool)>;

  /// It gets the arguments of each set().
  void observe(Observer observer) {
    const std::lock_guard<std::mutex> lock(mutex_);
    observer_ = std::move(observer);
  }

  void set(const std::string& kind, const std::string& name, bool requested) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (observer_) observer_(kind, name, requested);
    if (requested) {
      requested_.emplace(kind, name);
    } else {
      requested_.erase({kind, name});
    }
  }

  bool has(const std::string& kind, const std::string& name) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return requested_.count({kind, name}) > 0;
  }

 private:
  mutable std::mutex mutex_;
  std::set<std::pair<std::string, std::string>> requested_;
  Observer observer_;
};

}  // namespace angen::sim

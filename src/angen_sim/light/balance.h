#pragma once

#include <atomic>
#include <future>
#include <memory>
#include <vector>

#include "light/solution.h"

namespace angen::light {

/// A lamp and its light.
struct Solved {
  LampId id;
  std::uint64_t version = 0;  // grows when the lamp is moved
  std::shared_ptr<const Solution> solution;
};

/// The light between the surfaces of one scene.
struct Balance {
  Field field;
  std::vector<Solved> solved;
  std::vector<Solved> ahead;  // found before it was asked for; null if it is outdated
};

/// What there is to balance.
struct Request {
  struct Of {
    LampId id;
    std::uint64_t version = 0;
    Lamp lamp;
    bool lit = false;
  };
  std::shared_ptr<const rays::Scene> scene;  // has the standing shapes
  std::vector<Changes::Moved> moved;         // shapes that differ from the scene before
  std::vector<Of> lamps;
};

/// Whether one of the shapes was or is in the box, m.
bool any_in(const Eigen::AlignedBox3d& box, const std::vector<Changes::Moved>& moved);

/// The light of all lit lamps, and of others whose light is still that of before. The same request
/// gives the same light, whatever is known before and was found ahead; on any thread.
Balance balance(Balance before, const Request& request);

/// Finds the light of lamps before it is asked for, on another thread, until it is stopped.
class LookAhead {
 public:
  LookAhead(Balance from, std::vector<Request::Of> lamps);
  ~LookAhead() { stop_ = true; }
  LookAhead(const LookAhead&) = delete;
  LookAhead& operator=(const LookAhead&) = delete;

  void stop() { stop_ = true; }
  /// What it was given and has found. Once.
  Balance take() { return result_.get(); }

 private:
  std::atomic<bool> stop_{false};
  std::future<Balance> result_;  // its destructor waits for the thread
};

}  // namespace angen::light

#pragma once

#include <chrono>
#include <cstddef>

namespace angen::node {

/// How many clients of this node's services have closed their connection, or died, while it serves
/// their call. roscpp does not notice before it writes the answer.
std::size_t lost_clients();

/// Says of one call that waits among others whether its client is lost. Which of the calls a lost
/// client waits for is not known: it is said once as many clients are lost as calls wait.
class ClientWatch {
 public:
  /// `waiting`: calls that wait now, with this one. Checks twice a second, whoever calls more
  /// often.
  bool lost(std::size_t waiting);

 private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point checked_ = Clock::now();
  int times_ = 0;  // in a row
};

}  // namespace angen::node

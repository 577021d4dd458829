#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace angen::node {

/// Notices that the ROS master was restarted. It then knows none of this node's topics and
/// services, and roscpp does not register them again.
class MasterWatch {
 public:
  /// Watches from now on, in a thread of its own. The node is registered already.
  MasterWatch();
  ~MasterWatch();
  MasterWatch(const MasterWatch&) = delete;
  MasterWatch& operator=(const MasterWatch&) = delete;

  bool lost() const { return lost_; }

 private:
  void watch();

  std::atomic<bool> lost_{false};
  std::mutex mutex_;
  std::condition_variable wake_;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace angen::node

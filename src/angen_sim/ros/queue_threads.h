#pragma once

#include <pthread.h>
#include <ros/callback_queue.h>

#include <atomic>
#include <csignal>
#include <cstddef>
#include <thread>
#include <vector>

namespace angen::node {

/// Threads that run the callbacks of a queue. Those of ros::AsyncSpinner wake ten times a second
/// each where nothing comes, more often than the node itself at rest.
class QueueThreads {
 public:
  QueueThreads(ros::CallbackQueue& queue, std::size_t count) : queue_(queue), count_(count) {}
  ~QueueThreads() { stop(); }
  QueueThreads(const QueueThreads&) = delete;
  QueueThreads& operator=(const QueueThreads&) = delete;

  void start() {
    while (threads_.size() < count_) threads_.emplace_back([this] { run(); });
  }
  /// Returns when running callbacks have returned; no other is called.
  void stop() {
    ended_ = true;
    queue_.disable();
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
  }

 private:
  void run() {
    sigset_t all;  // the main thread takes signals
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, nullptr);
    const ros::WallDuration longest(10.0);  // a callback ends the wait, and so does stop()
    while (!ended_) queue_.callOne(longest);
  }

  ros::CallbackQueue& queue_;
  std::size_t count_;
  std::atomic<bool> ended_{false};
  std::vector<std::thread> threads_;
};

}  // namespace angen::node

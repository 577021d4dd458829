#pragma once

#include <ros/node_handle.h>
#include <ros/single_subscriber_publisher.h>
#include <ros/this_node.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "ros/registrar.h"

namespace angen::node {

/// To advertise or subscribe a topic that may go: a handle keeps some 300 bytes of each topic that
/// it was used for, as long as it lives.
inline ros::NodeHandle handle_for_one(const ros::NodeHandle& node) { return node; }

/// Messages that publishers of all kinds have sent since the start; each counts once, however many
/// listen.
class Traffic {
 public:
  static void count() { sent_.fetch_add(1, std::memory_order_relaxed); }
  static std::uint64_t sent() { return sent_.load(std::memory_order_relaxed); }

 private:
  static inline std::atomic<std::uint64_t> sent_{0};
};

/// A topic whose messages are made only while it has subscribers. Connect callbacks count them:
/// querying a publisher costs as much as publishing. The Registrar advertises it.
class LazyPublisher {
 public:
  /// Throws roscpp's exception for an invalid topic.
  template <class Message>
  static LazyPublisher of(ros::NodeHandle& node, const std::string& topic, std::uint32_t queue) {
    LazyPublisher made;
    ros::AdvertiseOptions options;
    const std::shared_ptr<Listeners> listeners = made.listeners_;
    options.init<Message>(
        topic, queue,
        [listeners](const ros::SingleSubscriberPublisher& subscriber) {
          if (is_this_node(subscriber)) return;
          ++listeners->count;
          ++listeners->joined;
        },
        [listeners](const ros::SingleSubscriberPublisher& subscriber) {
          if (!is_this_node(subscriber)) --listeners->count;
        });
    node.resolveName(topic);  // throws
    made.publisher_ = Registered<ros::Publisher>(
        [node, options]() mutable { return handle_for_one(node).advertise(options); });
    return made;
  }

  bool has_subscribers() const { return listeners_->count.load(std::memory_order_relaxed) > 0; }
  /// Grows with each new subscriber.
  std::uint64_t subscriptions() const { return listeners_->joined.load(std::memory_order_relaxed); }

  /// Publishes the message of `make`, which is not called while there are no subscribers.
  template <class Make>
  void publish(Make&& make) const {
    if (!has_subscribers()) return;
    const ros::Publisher* publisher = publisher_.get();
    if (publisher == nullptr) return;
    publisher->publish(make());
    Traffic::count();
  }

 private:
  // roscpp subscribes to /clock in each node, also in the one that publishes it.
  static bool is_this_node(const ros::SingleSubscriberPublisher& subscriber) {
    return subscriber.getSubscriberName() == ros::this_node::getName();
  }

  struct Listeners {
    std::atomic<int> count{0};
    std::atomic<std::uint64_t> joined{0};
  };

  std::shared_ptr<Listeners> listeners_ = std::make_shared<Listeners>();
  Registered<ros::Publisher> publisher_;
};

/// A latched topic: each newcomer gets the last message. It is made for the first
/// subscriber; with roscpp's own latch it would be made at each change.
template <class Message>
class LatchedLazyPublisher {
 public:
  using Make = std::function<Message()>;

  /// Throws roscpp's exception for an invalid topic.
  LatchedLazyPublisher(ros::NodeHandle& node, const std::string& topic, std::uint32_t queue) {
    ros::AdvertiseOptions latch;  // connection headers say that the topic is latched
    latch.init<Message>(topic, queue);
    latch.latch = true;
    const std::shared_ptr<State> state = state_;
    ros::AdvertiseOptions options;
    options.init<Message>(
        topic, queue,
        [state](const ros::SingleSubscriberPublisher& newcomer) {
          const std::lock_guard<std::mutex> lock(state->mutex);
          ++state->listeners;
          if (!state->make) return;
          newcomer.publish(state->make());
          Traffic::count();
        },
        [state](const ros::SingleSubscriberPublisher&) {
          const std::lock_guard<std::mutex> lock(state->mutex);
          --state->listeners;
        });
    node.resolveName(topic);  // throws
    publishers_ = Registered<Publishers>(
        [node, latch, options]() mutable {
          ros::Publisher latched = handle_for_one(node).advertise(latch);
          return Publishers{latched, handle_for_one(node).advertise(options)};
        },
        // A newcomer may have missed a message that was set before get() returned the publisher.
        [state](const Publishers& publishers) {
          const std::lock_guard<std::mutex> lock(state->mutex);
          if (state->make) state->send(publishers.publisher, state->make);
        });
  }

  /// From now on `make` makes the message; it may be called by any thread until the next
  /// call of this. Present subscribers get it too if `is_news`.
  void set(Make make, bool is_news = true) {
    const std::lock_guard<std::mutex> lock(state_->mutex);
    state_->make = std::move(make);
    if (is_news) send(state_->make);
  }

  /// Present subscribers get the message again.
  void repeat() {
    const std::lock_guard<std::mutex> lock(state_->mutex);
    if (state_->make) send(state_->make);
  }

  /// Present subscribers get the message of `make`, new ones get all.
  template <class Part>
  void publish(Part&& make) {
    const std::lock_guard<std::mutex> lock(state_->mutex);
    send(make);
  }

 private:
  struct Publishers {
    ros::Publisher latch;
    ros::Publisher publisher;
  };

  struct State {
    template <class Any>
    void send(const ros::Publisher& publisher, Any& make_message) const {
      if (listeners == 0) return;
      publisher.publish(make_message());
      Traffic::count();
    }

    std::mutex mutex;  // a newcomer never gets an older message after a newer one
    int listeners = 0;
    Make make;
  };

  template <class Any>
  void send(Any& make) const {
    if (const Publishers* made = publishers_.get()) state_->send(made->publisher, make);
  }

  std::shared_ptr<State> state_ = std::make_shared<State>();
  Registered<Publishers> publishers_;
};

}  // namespace angen::node

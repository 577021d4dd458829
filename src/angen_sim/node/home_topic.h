#pragma once

#include <angen_msgs/Home.h>

#include <memory>

#include "ros/lazy_publisher.h"
#include "sim/snapshot.h"

namespace angen::node {

angen_msgs::Home to_message(const Home& home);

/// /angen/home: the home's description, again whenever a model that it depends on is added or
/// removed.
class HomeTopic {
 public:
  explicit HomeTopic(ros::NodeHandle& node);

  void on_structure(const sim::Structure& structure);

 private:
  LatchedLazyPublisher<angen_msgs::Home> publisher_;
  std::shared_ptr<const DerivedHome> home_;  // the last one published
};

}  // namespace angen::node

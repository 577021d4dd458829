#pragma once

#include <ros/datatypes.h>

#include <chrono>
#include <string>

namespace angen::node {

/// Whether the client of a call of a service is still connected.
class ClientWatch {
 public:
  /// `header`: the connection's, as ros::ServiceEvent has it; it tells connections apart.
  ClientWatch(std::string service, const ros::M_string& header)
      : service_(std::move(service)), header_(&header) {}

  /// Checks twice a second, however often it is called.
  bool lost();

 private:
  using Clock = std::chrono::steady_clock;

  std::string service_;
  const ros::M_string* header_;
  Clock::time_point checked_ = Clock::now();
};

}  // namespace angen::node

#pragma once

#include <ros/callback_queue.h>
#include <ros/service_server.h>
#include <roscpp/GetLoggers.h>
#include <roscpp/SetLoggerLevel.h>

#include <string>

namespace angen::node {

/// `~get_loggers` and `~set_logger_level` in place of those of roscpp: its list of loggers deletes
/// the loggers (rosconsole 1.14 with log4cxx 1.0), so that the next log line ends the node, and it
/// makes a logger of every name, of any length.
class LoggerServices {
 public:
  explicit LoggerServices(ros::CallbackQueue& queue);

 private:
  bool list(roscpp::GetLoggers::Request& request, roscpp::GetLoggers::Response& response);
  bool set_level(roscpp::SetLoggerLevel::Request& request,
                 roscpp::SetLoggerLevel::Response& response);

  ros::ServiceServer list_, set_level_;
};

}  // namespace angen::node

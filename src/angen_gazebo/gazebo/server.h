#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <string>
#include <vector>

#include "core/diagnostics.h"

/// The services and topics of gazebo_ros, under /gazebo; one file for each group of them.
namespace angen::node::gazebo {

/// Something that a request names does not exist: clients get gazebo_ros's text, the log the
/// details too.
class NotFound : public Error {
 public:
  NotFound(const std::string& text, const std::string& details)
      : Error(text + " (" + details + ")"), text_(text) {}
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// A failure whose whole text clients may compare.
class Failed : public Error {
 public:
  using Error::Error;
};

/// Serves requests by functions that return the status message, or throw why nothing was done.
class Server {
 public:
  explicit Server(const ros::NodeHandle& node) : node_(node) {}

  /// `title` precedes the message of a failure.
  template <class Service>
  using Handler =
      std::function<std::string(const typename Service::Request&, typename Service::Response&)>;
  template <class Service>
  void serve(const std::string& name, const std::string& title, Handler<Service> handler) {
    using Request = typename Service::Request;
    using Response = typename Service::Response;
    const boost::function<bool(Request&, Response&)> called =
        [title, handler = std::move(handler)](Request& request, Response& response) {
          try {
            response.status_message = handler(request, response);
            response.success = true;
          } catch (const std::exception& problem) {
            response = Response();  // with nothing that was filled in before
            response.success = false;
            response.status_message = status_of(title, problem);
          }
          return true;
        };
    servers_.push_back(node_.advertiseService("gazebo/" + name, called));
  }

  /// A request whose answer is empty: an exception is logged, and the call succeeds as
  /// gazebo_ros's does.
  template <class Service>
  void serve_silently(const std::string& name, const std::string& title,
                      std::function<void(const typename Service::Request&)> handler) {
    using Request = typename Service::Request;
    using Response = typename Service::Response;
    const boost::function<bool(Request&, Response&)> called = [title, handler = std::move(handler)](
                                                                  Request& request, Response&) {
      try {
        handler(request);
      } catch (const std::exception& problem) {
        status_of(title, problem);
      }
      return true;
    };
    servers_.push_back(node_.advertiseService("gazebo/" + name, called));
  }

 private:
  /// The client's answer, which is logged too.
  static std::string status_of(const std::string& title, const std::exception& problem);

  ros::NodeHandle node_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace angen::node::gazebo

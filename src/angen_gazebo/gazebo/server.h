#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/diagnostics.h"
#include "ros/inbox.h"

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
  Server(const ros::NodeHandle& node, Inbox& inbox) : node_(node), inbox_(inbox) {}
  Inbox& inbox() { return inbox_; }

  template <class Service>
  using Handler =
      std::function<std::string(const typename Service::Request&, typename Service::Response&)>;
  template <class Service>
  using Answer = std::string (*)(Inbox&, const typename Service::Request&,
                                 typename Service::Response&);

  /// `title` precedes the message of a failure. If the response has no status, an exception is
  /// logged, and the call succeeds as gazebo_ros's does.
  template <class Service>
  void serve(const std::string& name, const std::string& title, Handler<Service> handler) {
    using Request = typename Service::Request;
    using Response = typename Service::Response;
    const boost::function<bool(Request&, Response&)> called =
        [title, handler = std::move(handler)](Request& request, Response& response) {
          try {
            set_status(response, true, handler(request, response));
          } catch (const std::exception& problem) {
            response = Response();  // with nothing that was filled in before
            set_status(response, false, status_of(title, problem));
          }
          return true;
        };
    servers_.push_back(node_.advertiseService("gazebo/" + name, called));
  }
  /// The service whose name is the title in lower case, such as get_link_state of GetLinkState.
  template <class Service>
  void serve(const std::string& title, Handler<Service> handler) {
    serve<Service>(name_of(title), title, std::move(handler));
  }
  template <class Service>
  void serve(const std::string& title, Answer<Service> answer) {
    serve<Service>(title, [this, answer](const auto& request, auto& response) {
      return answer(inbox_, request, response);
    });
  }

 private:
  template <class Response, class = void>
  struct HasStatus : std::false_type {};
  template <class Response>
  struct HasStatus<Response, std::void_t<decltype(Response::status_message)>> : std::true_type {};

  template <class Response>
  static void set_status(Response& response, bool success, std::string message) {
    if constexpr (HasStatus<Response>::value) {
      response.success = success;
      response.status_message = std::move(message);
    }
  }
  static std::string name_of(const std::string& title);
  /// The client's answer, which is logged too.
  static std::string status_of(const std::string& title, const std::exception& problem);

  ros::NodeHandle node_;
  Inbox& inbox_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace angen::node::gazebo

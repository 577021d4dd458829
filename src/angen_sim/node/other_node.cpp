#include "node/other_node.h"

#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <ros/console.h>
#include <ros/master.h>
#include <ros/names.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>

#include "core/diagnostics.h"
#include "core/files.h"
#include "node/services.h"

namespace angen::node {
namespace {

constexpr int kConnectLimit = 2000;  // ms
constexpr int kTries = 50;           // for a service that another one has locked
constexpr std::chrono::milliseconds kBetweenTries(100);

bool connects(const addrinfo& address) {
  const int file = socket(address.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (file < 0) return false;
  bool connected = connect(file, address.ai_addr, address.ai_addrlen) == 0;
  if (!connected && errno == EINPROGRESS) {
    pollfd waits{file, POLLOUT, 0};
    int problem = ETIMEDOUT;
    socklen_t size = sizeof problem;
    connected = poll(&waits, 1, kConnectLimit) == 1 &&
                getsockopt(file, SOL_SOCKET, SO_ERROR, &problem, &size) == 0 && problem == 0;
  }
  close(file);
  return connected;
}

/// Whether a process serves at the address of a node.
bool answers(const std::string& uri) {
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(uri, host, port)) return false;
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found) != 0) return false;
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> owner(found, freeaddrinfo);
  for (const addrinfo* at = found; at != nullptr; at = at->ai_next) {
    if (connects(*at)) return true;
  }
  return false;
}

/// The result of a call to the master; empty if it has none.
XmlRpc::XmlRpcValue asked(const char* method, const std::string& about) {
  XmlRpc::XmlRpcValue request, response, result;
  request[0] = ros::this_node::getName();
  if (!about.empty()) request[1] = about;
  if (!ros::master::execute(method, request, response, result, true)) return {};
  return result;
}

/// Where the node of this name serves; empty if there is none.
std::string uri_of(const std::string& name) {
  XmlRpc::XmlRpcValue uri = asked("lookupNode", name);
  if (uri.getType() != XmlRpc::XmlRpcValue::TypeString || !answers(uri)) return "";
  return uri;
}

/// The node that provides a service; empty if none does.
std::string provider_of(const std::string& service) {
  XmlRpc::XmlRpcValue state = asked("getSystemState", "");
  if (state.getType() != XmlRpc::XmlRpcValue::TypeArray) return "";
  XmlRpc::XmlRpcValue& services = state[2];
  for (int i = 0; i < services.size(); ++i) {
    if (static_cast<std::string>(services[i][0]) == service) return services[i][1][0];
  }
  return "";
}

/// A running node with this one's name or services; empty if there is none.
std::string other_node(const std::string& service) {
  for (const std::string& name : {ros::this_node::getName(), provider_of(service)}) {
    if (!name.empty() && !uri_of(name).empty()) return name;
  }
  return "";
}

/// Machines may share a home folder and each have a master at localhost.
std::string machine() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

/// Nodes that start at once all find the service free at the master: the first one locks it.
bool locks(const std::string& service) {
  try {
    make_private_folder(state_folder());
    return lock_until_exit(state_folder() + "/nodes.lock",
                           machine() + " " + ros::master::getURI() + " " + service);
  } catch (const Error& error) {
    ROS_WARN("a simulator that starts at the same time is not noticed: %s", error.what());
    return true;
  }
}

}  // namespace

void require_no_other_node(bool replaces) {
  const std::string& own = ros::this_node::getName();
  const std::string service = ros::names::resolve(kListService);
  bool locked = locks(service);
  std::string other = other_node(service);
  if (replaces && (other.empty() || other == own)) return;
  // A node that starts is registered soon, and one that ends releases its names.
  for (int tries = 0; !locked && other.empty() && tries < kTries; ++tries) {
    std::this_thread::sleep_for(kBetweenTries);
    locked = locks(service);
    other = other_node(service);
  }
  if (locked && other.empty()) return;
  if (other.empty()) other = own;
  throw Error("a simulator runs already in the namespace " + ros::this_node::getNamespace() +
              ": node " + other + (other == own ? ", which this one would end" : "") +
              "; end it by rosnode kill " + other +
              (other == own ? ", replace it by _replace:=true" : "") +
              ", or start this one in another namespace, as by ROS_NAMESPACE=house2, or with a "
              "master of its own, by ROS_MASTER_URI");
}

}  // namespace angen::node

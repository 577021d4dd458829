#include "node/other_node.h"

#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <ros/console.h>
#include <ros/master.h>
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
#include "core/private_file.h"
#include "core/process_lock.h"

namespace angen::node {
namespace {

constexpr int kConnectLimit = 2000;  // ms
constexpr int kTries = 50;           // for a name that another one has locked
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

/// Where the node of this name serves; empty where there is none.
std::string other_uri(const std::string& name) {
  XmlRpc::XmlRpcValue request, response, uri;
  request[0] = name;
  request[1] = name;
  if (!ros::master::execute("lookupNode", request, response, uri, true)) return "";
  if (uri.getType() != XmlRpc::XmlRpcValue::TypeString || !answers(uri)) return "";
  return uri;
}

/// Machines may share a home folder and each have a master at localhost.
std::string machine() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

/// Nodes that start at once all find the name free at the master: the first one locks it.
bool locks_name(const std::string& name) {
  try {
    make_private_folder(state_folder());
    return lock_until_exit(state_folder() + "/nodes.lock",
                           machine() + " " + ros::master::getURI() + " " + name);
  } catch (const Error& error) {
    ROS_WARN("a node %s that starts at the same time is not noticed: %s", name.c_str(),
             error.what());
    return true;
  }
}

}  // namespace

void require_no_other_node(bool replaces) {
  const std::string& name = ros::this_node::getName();
  bool locked = locks_name(name);
  if (replaces) return;
  std::string uri = other_uri(name);
  // A node that starts is registered soon, and one that ends releases the name.
  for (int tries = 0; !locked && uri.empty() && tries < kTries; ++tries) {
    std::this_thread::sleep_for(kBetweenTries);
    locked = locks_name(name);
    uri = other_uri(name);
  }
  if (locked && uri.empty()) return;
  throw Error("a node " + name + " runs already" + (uri.empty() ? "" : " at " + uri) +
              " and would be ended by this one; end it by rosnode kill " + name +
              ", replace it by _replace:=true, or give this one a master of its own by "
              "ROS_MASTER_URI");
}

}  // namespace angen::node

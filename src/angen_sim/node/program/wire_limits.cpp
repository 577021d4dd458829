// Limits of what others send to the node. roscpp reserves up to 1 GB for a message of a client, and
// its XML-RPC server reads calls of any size and depth. The functions below take the place of
// theirs: the definitions of a program come before those of its shared libraries.
#include <XmlRpcServerConnection.h>
#include <XmlRpcSocket.h>
#include <dlfcn.h>
#include <ros/connection.h>
#include <ros/console.h>
#include <ros/service_client_link.h>
#include <ros/transport_publisher_link.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

namespace {

constexpr std::uint32_t kLargestHeader = 1U << 20U;    // bytes, of a connection
constexpr std::uint32_t kLargestMessage = 16U << 20U;  // bytes; a text may have 4 MB
constexpr std::size_t kLargestCall = 1U << 20U;        // bytes, of XML-RPC or its header
constexpr int kDeepestCall = 100;                      // values in each other
constexpr std::size_t kReadAtOnce = 1U << 16U;         // bytes

using ros::ConnectionPtr;
using Buffer = boost::shared_array<std::uint8_t>;

/// The function of the library whose place `ours` takes.
template <class Function, class Ours>
Function* library_function(Ours ours) {
  void* address = nullptr;
  std::memcpy(&address, &ours, sizeof address);
  Dl_info info{};
  void* found = dladdr(address, &info) != 0 && info.dli_sname != nullptr
                    ? dlsym(RTLD_NEXT, info.dli_sname)
                    : nullptr;
  if (found == nullptr) {
    std::fputs("angen_node: roscpp lacks a function that Angen limits\n", stderr);
    std::abort();
  }
  return reinterpret_cast<Function*>(found);
}

bool exceeds(const char* what, const Buffer& length, bool success, std::uint32_t limit,
             ros::Connection& from) {
  std::uint32_t bytes = 0;
  if (!success) return false;
  std::memcpy(&bytes, length.get(), sizeof bytes);
  if (bytes <= limit) return false;
  ROS_WARN("%s of %u bytes from %s is rejected: it may have %u", what, bytes,
           from.getRemoteString().c_str(), limit);
  return true;
}

/// Whether the values of a call are in each other deeper than `limit`.
bool is_deeper(const std::string& call, int limit) {
  constexpr std::string_view kBegin = "<value>", kEnd = "</value>";
  int depth = 0;
  for (std::size_t at = call.find('<'); at != std::string::npos; at = call.find('<', at + 1)) {
    if (call.compare(at, kBegin.size(), kBegin) == 0 && ++depth > limit) return true;
    if (call.compare(at, kEnd.size(), kEnd) == 0) --depth;
  }
  return false;
}

}  // namespace

void ros::Connection::onHeaderLengthRead(const ConnectionPtr& connection, const Buffer& length,
                                         std::uint32_t size, bool success) {
  using Read = void(Connection*, const ConnectionPtr&, const Buffer&, std::uint32_t, bool);
  static Read* const go_on = library_function<Read>(&Connection::onHeaderLengthRead);
  if (exceeds("a header", length, success, kLargestHeader, *connection)) {
    connection->drop(HeaderError);
  } else {
    go_on(this, connection, length, size, success);
  }
}

void ros::ServiceClientLink::onRequestLength(const ConnectionPtr& connection, const Buffer& length,
                                             std::uint32_t size, bool success) {
  using Read = void(ServiceClientLink*, const ConnectionPtr&, const Buffer&, std::uint32_t, bool);
  static Read* const go_on = library_function<Read>(&ServiceClientLink::onRequestLength);
  if (exceeds("a request", length, success, kLargestMessage, *connection)) {
    connection->drop(Connection::Destructing);
  } else {
    go_on(this, connection, length, size, success);
  }
}

void ros::TransportPublisherLink::onMessageLength(const ConnectionPtr& connection,
                                                  const Buffer& length, std::uint32_t size,
                                                  bool success) {
  using Read =
      void(TransportPublisherLink*, const ConnectionPtr&, const Buffer&, std::uint32_t, bool);
  static Read* const go_on = library_function<Read>(&TransportPublisherLink::onMessageLength);
  if (exceeds("a message", length, success, kLargestMessage, *connection)) {
    drop();
  } else {
    go_on(this, connection, length, size, success);
  }
}

/// Reads a part of what has arrived; the rest is read when the caller is called again.
bool XmlRpc::XmlRpcSocket::nbRead(int socket, std::string& text, bool* ended) {
  const std::size_t before = text.size();
  text.resize(before + kReadAtOnce);
  const ssize_t count = recv(socket, &text[before], kReadAtOnce, 0);
  const int problem = errno;
  text.resize(before + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  *ended = count == 0;
  return count >= 0 || problem == EAGAIN || problem == EWOULDBLOCK || problem == EINTR;
}

bool XmlRpc::XmlRpcServerConnection::readHeader() {
  using Read = bool(XmlRpcServerConnection*);
  static Read* const go_on = library_function<Read>(&XmlRpcServerConnection::readHeader);
  if (!go_on(this)) return false;
  if (_connectionState == READ_HEADER) return _header.size() <= kLargestCall;
  return _contentLength <= static_cast<int>(kLargestCall);
}

bool XmlRpc::XmlRpcServerConnection::readRequest() {
  using Read = bool(XmlRpcServerConnection*);
  static Read* const go_on = library_function<Read>(&XmlRpcServerConnection::readRequest);
  if (!go_on(this)) return false;
  return _connectionState == READ_REQUEST || !is_deeper(_request, kDeepestCall);
}

#include "ros/lost_clients.h"

#include <ros/connection_manager.h>

#include <fstream>
#include <sstream>
#include <string>

namespace angen::node {
namespace {

constexpr std::chrono::milliseconds kPeriod(500);
constexpr int kSure = 2;  // checks in a row: roscpp may be about to close the connection itself
constexpr char kCloseWait[] = "08";

// A line of proc_net_tcp(5): number, local and remote address as HEX:PORT, state, ...
std::size_t closed_by_peer(const char* file, unsigned port) {
  std::ifstream table(file);
  std::size_t count = 0;
  std::string line, number, local, remote, state;
  for (std::getline(table, line); std::getline(table, line);) {
    std::istringstream words(line);
    if (!(words >> number >> local >> remote >> state) || state != kCloseWait) continue;
    const std::size_t colon = local.rfind(':');
    if (std::strtoul(local.c_str() + colon + 1, nullptr, 16) == port) ++count;
  }
  return count;
}

}  // namespace

std::size_t lost_clients() {
  const unsigned port = ros::ConnectionManager::instance()->getTCPPort();
  return closed_by_peer("/proc/self/net/tcp", port) + closed_by_peer("/proc/self/net/tcp6", port);
}

bool ClientWatch::lost(std::size_t waiting) {
  const Clock::time_point now = Clock::now();
  if (now - checked_ < kPeriod) return false;
  checked_ = now;
  times_ = lost_clients() >= waiting ? times_ + 1 : 0;
  return times_ >= kSure;
}

}  // namespace angen::node

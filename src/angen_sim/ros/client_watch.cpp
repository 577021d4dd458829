#include "ros/client_watch.h"

#include <ros/connection.h>
#include <ros/service_client_link.h>
#include <ros/service_manager.h>
#include <ros/service_publication.h>

#include <algorithm>

namespace angen::node {
namespace {

constexpr std::chrono::milliseconds kClientPeriod(500);

// roscpp drops the connection of a client that has ended, but does not report it: its list of open
// ones is private. An explicit instantiation may name private members.
template <auto Links, auto Mutex>
struct OpenLinks {
  friend ros::V_ServiceClientLink& links_of(ros::ServicePublication& service) {
    return service.*Links;
  }
  friend boost::mutex& mutex_of(ros::ServicePublication& service) { return service.*Mutex; }
};
ros::V_ServiceClientLink& links_of(ros::ServicePublication& service);
boost::mutex& mutex_of(ros::ServicePublication& service);
template struct OpenLinks<&ros::ServicePublication::client_links_,
                          &ros::ServicePublication::client_links_mutex_>;

}  // namespace

bool ClientWatch::lost() {
  const Clock::time_point now = Clock::now();
  if (now - checked_ < kClientPeriod) return false;
  checked_ = now;
  const auto service = ros::ServiceManager::instance()->lookupServicePublication(service_);
  if (!service) return false;
  const boost::mutex::scoped_lock lock(mutex_of(*service));
  const ros::V_ServiceClientLink& links = links_of(*service);
  return std::none_of(links.begin(), links.end(), [&](const auto& link) {
    return link->getConnection()->getHeader().getValues().get() == header_;
  });
}

}  // namespace angen::node

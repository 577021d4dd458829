#include <air_quality/Co2Msg.h>
#include <ros/ros_kind.h>

namespace {

void fill(const angen::Reading& reading, const angen::node::Label&, air_quality::Co2Msg& message) {
  message.concentration = reading.get<double>("concentration");
  message.stale = reading.get<bool>("stale");
}

ANGEN_REGISTER_ROS_KIND(
    {"co2"}, angen::node::RosKindBuilder().message<air_quality::Co2Msg>(&fill).caption());

}  // namespace

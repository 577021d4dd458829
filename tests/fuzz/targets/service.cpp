#include <angen_msgs/Delete.h>
#include <angen_msgs/SendCommand.h>
#include <angen_msgs/Spawn.h>
#include <ros/serialization.h>

#include <optional>

#include "fuzz/targets.h"
#include "ros/requests.h"
#include "ros/text.h"

namespace angen::fuzz {
namespace {

// As roscpp reads a request; it answers an exception with "false" itself.
template <class Request>
std::optional<Request> deserialized(const std::string& bytes) {
  std::vector<std::uint8_t> copy(bytes.begin(), bytes.end());
  ros::serialization::IStream stream(copy.data(), static_cast<std::uint32_t>(copy.size()));
  Request request;
  try {
    ros::serialization::deserialize(stream, request);
  } catch (const ros::serialization::StreamOverrunException&) {
    return std::nullopt;
  }
  return request;
}

}  // namespace

void service(const std::string& input) {
  const Split given = split(input);
  answered([&] {
    if (given.choice % 3 == 0) {
      const auto request = deserialized<angen_msgs::SpawnRequest>(given.rest);
      if (request) node::spawn_action(*request, {});
    } else if (given.choice % 3 == 1) {
      const auto request = deserialized<angen_msgs::DeleteRequest>(given.rest);
      if (request) node::delete_action(*request);
    } else {
      const auto request = deserialized<angen_msgs::SendCommandRequest>(given.rest);
      if (request) node::any_action(request->target, request->text);
    }
  });
}

}  // namespace angen::fuzz

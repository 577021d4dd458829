#include <angen_msgs/Delete.h>
#include <angen_msgs/SendCommand.h>
#include <angen_msgs/Spawn.h>
#include <ros/serialization.h>

#include <optional>

#include "core/names.h"
#include "fuzz/targets.h"
#include "node/text.h"
#include "sdf/load.h"

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

// As the node parses a model to spawn, before it queues it.
void parse(const angen_msgs::SpawnRequest& request) {
  check_name(request.name);
  if (load::is_sensor(request.xml)) {
    load::sensor(request.xml, request.name, {});
  } else {
    load::model(request.xml, request.name, {}, {});
  }
}

}  // namespace

void service(const std::string& input) {
  const Split given = split(input);
  answered([&] {
    if (given.choice % 3 == 0) {
      const auto request = deserialized<angen_msgs::SpawnRequest>(given.rest);
      if (request) parse(*request);
    } else if (given.choice % 3 == 1) {
      const auto request = deserialized<angen_msgs::DeleteRequest>(given.rest);
      if (request) check_name(request->name);
    } else {
      const auto request = deserialized<angen_msgs::SendCommandRequest>(given.rest);
      if (request) node::any_action(request->target, request->text);
    }
  });
}

}  // namespace angen::fuzz

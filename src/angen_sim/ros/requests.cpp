#include "ros/requests.h"

#include <cmath>

#include "core/diagnostics.h"
#include "core/names.h"
#include "core/text.h"

namespace angen::node {
namespace {

// A message whose quaternion nobody filled means no rotation.
Pose to_pose(const geometry_msgs::Pose& message) {
  Pose pose;
  pose.position = {message.position.x, message.position.y, message.position.z};
  const geometry_msgs::Quaternion& q = message.orientation;
  pose.rotation = Quat(q.w, q.x, q.y, q.z);
  if (!pose.finite()) throw Error("the pose holds a number that is not finite");
  const double norm = pose.rotation.norm();
  if (norm == 0.0) {
    pose.rotation = Quat::Identity();
  } else if (std::abs(norm - 1.0) > 0.01) {
    throw Error("the pose's quaternion has length " + std::to_string(norm) + ", must have 1");
  } else {
    pose.rotation.normalize();
  }
  return pose;
}

}  // namespace

sim::Action spawn_action(const angen_msgs::SpawnRequest& request, const load::SearchPaths& paths) {
  check_name(request.name);
  if (trimmed(request.xml).empty()) throw Error("nothing to spawn: xml is empty");
  if (!valid_utf8(request.xml)) throw Error("xml is not UTF-8");
  const Pose pose = to_pose(request.pose);
  const bool lone_sensor = load::is_sensor(request.xml);
  if (lone_sensor && request.on.empty()) {
    throw Error("a lone <sensor> needs a link to sit on: give `on` as MODEL::LINK");
  }
  if (!lone_sensor && !request.on.empty()) {
    throw Error("only a <sensor> can be put on a link, and xml holds none");
  }
  if (!valid_utf8(request.on)) throw Error("`on` is not UTF-8");
  if (lone_sensor) return sim::Attach{load::sensor(request.xml, request.name, pose), request.on};
  return sim::Spawn{load::model(request.xml, request.name, pose, paths)};
}

sim::Action delete_action(const angen_msgs::DeleteRequest& request) {
  check_name(request.name);
  return sim::Delete{request.name};
}

}  // namespace angen::node

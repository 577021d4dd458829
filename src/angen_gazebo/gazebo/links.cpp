#include <gazebo_msgs/ApplyBodyWrench.h>
#include <gazebo_msgs/BodyRequest.h>
#include <gazebo_msgs/GetLinkProperties.h>
#include <gazebo_msgs/GetLinkState.h>
#include <gazebo_msgs/SetLinkProperties.h>
#include <gazebo_msgs/SetLinkState.h>

#include "gazebo/names.h"
#include "gazebo/services.h"
#include "gazebo/states.h"
#include "ros/convert.h"

namespace angen::node::gazebo {

namespace {

constexpr const char* kNoLink = "link not found, did you forget to scope the link by model name?";

std::string get_state(Inbox& inbox, const gazebo_msgs::GetLinkState::Request& request,
                      gazebo_msgs::GetLinkState::Response& response) {
  const auto structure = structure_of(inbox);
  const std::string& link = link_named(*structure, request.link_name, kNoLink).name;
  const std::string frame = frame_named(
      *structure, request.reference_frame,
      "reference reference_frame not found, did you forget to scope the link by model name?");
  const sim::Observed seen = observe(inbox, {{link, frame}, {}});
  const sim::Motion motion = relative(seen.entities[0], seen.entities[1]);
  response.link_state.link_name = request.link_name;
  response.link_state.pose = to_ros(motion.pose);
  response.link_state.twist = twist_of(motion);
  response.link_state.reference_frame = request.reference_frame;
  return "GetLinkState: got state";
}

std::string get_properties(Inbox& inbox, const gazebo_msgs::GetLinkProperties::Request& request,
                           gazebo_msgs::GetLinkProperties::Response& response) {
  const auto structure = structure_of(inbox);
  const desc::Link& link = structure->described(link_named(*structure, request.link_name, kNoLink));
  const Eigen::Matrix3d& moment = link.inertial.moment;
  response.com = to_ros(link.inertial.pose);
  response.gravity_mode = static_cast<unsigned char>(link.gravity);
  response.mass = link.inertial.mass;
  response.ixx = moment(0, 0);
  response.ixy = moment(0, 1);
  response.ixz = moment(0, 2);
  response.iyy = moment(1, 1);
  response.iyz = moment(1, 2);
  response.izz = moment(2, 2);
  return "GetLinkProperties: got properties";
}

std::string set_properties(Inbox& inbox, const gazebo_msgs::SetLinkProperties::Request& request) {
  const auto structure = structure_of(inbox);
  sim::SetLinkProperties to;
  to.link = link_named(*structure, request.link_name, kNoLink).name;
  to.gravity = request.gravity_mode != 0;
  to.inertial.pose = pose_of(request.com);
  to.inertial.mass = request.mass;
  to.inertial.moment << request.ixx, request.ixy, request.ixz,  //
      request.ixy, request.iyy, request.iyz,                    //
      request.ixz, request.iyz, request.izz;
  edit(inbox, to);
  return "SetLinkProperties: properties set";
}

std::string apply_wrench(Inbox& inbox, const gazebo_msgs::ApplyBodyWrench::Request& request) {
  const auto structure = structure_of(inbox);
  sim::PushLink push;
  push.link = link_named(*structure, request.body_name, "body does not exist").name;
  push.frame = frame_named(*structure, request.reference_frame, "reference_frame not found");
  push.point = vector_of(request.reference_point);
  push.force = vector_of(request.wrench.force);
  push.torque = vector_of(request.wrench.torque);
  push.time = push_time(request.start_time, request.duration);
  edit(inbox, push);
  return "";
}

}  // namespace

sim::Edit edit_of(const sim::Structure& structure, const gazebo_msgs::LinkState& state) {
  return sim::SetLinkState{
      link_named(structure, state.link_name, "link does not exist").name,
      {frame_named(structure, state.reference_frame, "failed"), pose_of(state.pose),
       vector_of(state.twist.linear), vector_of(state.twist.angular)}};
}

void serve_links(Server& server, Inbox& inbox) {
  using namespace gazebo_msgs;
  server.serve<GetLinkState>(
      "get_link_state", "GetLinkState",
      [&](const auto& request, auto& response) { return get_state(inbox, request, response); });
  server.serve<GetLinkProperties>("get_link_properties", "GetLinkProperties",
                                  [&](const auto& request, auto& response) {
                                    return get_properties(inbox, request, response);
                                  });
  server.serve<SetLinkState>("set_link_state", "SetLinkState", [&](const auto& request, auto&) {
    edit(inbox, edit_of(*structure_of(inbox), request.link_state));
    return "SetLinkState: success";
  });
  server.serve<SetLinkProperties>(
      "set_link_properties", "SetLinkProperties",
      [&](const auto& request, auto&) { return set_properties(inbox, request); });
  server.serve<ApplyBodyWrench>(
      "apply_body_wrench", "ApplyBodyWrench",
      [&](const auto& request, auto&) { return apply_wrench(inbox, request); });
  server.serve_silently<BodyRequest>(
      "clear_body_wrenches", "ClearBodyWrenches", [&](const auto& request) {
        const auto structure = structure_of(inbox);
        edit(inbox, sim::ClearPushes{
                        link_named(*structure, request.body_name, "body does not exist").name});
      });
}

}  // namespace angen::node::gazebo

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

using namespace gazebo_msgs;

constexpr const char* kNoLink = "link not found, did you forget to scope the link by model name?";

std::string get_state(Inbox& inbox, const GetLinkState::Request& request,
                      GetLinkState::Response& response) {
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

std::string get_properties(Inbox& inbox, const GetLinkProperties::Request& request,
                           GetLinkProperties::Response& response) {
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

std::string set_properties(Inbox& inbox, const SetLinkProperties::Request& request,
                           SetLinkProperties::Response&) {
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

std::string apply_wrench(Inbox& inbox, const ApplyBodyWrench::Request& request,
                         ApplyBodyWrench::Response&) {
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

std::string clear_wrenches(Inbox& inbox, const BodyRequest::Request& request,
                           BodyRequest::Response&) {
  const auto structure = structure_of(inbox);
  edit(inbox,
       sim::ClearPushes{link_named(*structure, request.body_name, "body does not exist").name});
  return "";
}

std::string set_state(Inbox& inbox, const SetLinkState::Request& request, SetLinkState::Response&) {
  edit(inbox, edit_of(*structure_of(inbox), request.link_state));
  return "SetLinkState: success";
}

}  // namespace

sim::Edit edit_of(const sim::Structure& structure, const LinkState& state) {
  return sim::SetLinkState{
      link_named(structure, state.link_name, "link does not exist").name,
      {frame_named(structure, state.reference_frame, "failed"), pose_of(state.pose),
       vector_of(state.twist.linear), vector_of(state.twist.angular)}};
}

void serve_links(Server& server) {
  server.serve<GetLinkState>("GetLinkState", &get_state);
  server.serve<GetLinkProperties>("GetLinkProperties", &get_properties);
  server.serve<SetLinkState>("SetLinkState", &set_state);
  server.serve<SetLinkProperties>("SetLinkProperties", &set_properties);
  server.serve<ApplyBodyWrench>("ApplyBodyWrench", &apply_wrench);
  server.serve<BodyRequest>("ClearBodyWrenches", &clear_wrenches);
}

}  // namespace angen::node::gazebo

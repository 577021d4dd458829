#include <gazebo_msgs/ApplyJointEffort.h>
#include <gazebo_msgs/GetJointProperties.h>
#include <gazebo_msgs/JointRequest.h>
#include <gazebo_msgs/SetJointProperties.h>

#include <cmath>

#include "gazebo/names.h"
#include "gazebo/services.h"

namespace angen::node::gazebo {

namespace {

using namespace gazebo_msgs;

using Answer = GetJointProperties::Response;

constexpr const char* kNoJoint = "joint not found";
constexpr double kUnlimited = 1e15;  // rad; SDF writes 1e16

std::uint8_t type_of(const desc::Joint& joint) {
  switch (joint.type) {
    case desc::Joint::Type::kFixed:
      return Answer::FIXED;
    case desc::Joint::Type::kPrismatic:
      return Answer::PRISMATIC;
    case desc::Joint::Type::kBall:
      return Answer::BALL;
    case desc::Joint::Type::kUniversal:
      return Answer::UNIVERSAL;
    case desc::Joint::Type::kRevolute:
    case desc::Joint::Type::kScrew:  // for which the message has no number
      break;
  }
  const bool limited = !joint.axes.empty() &&
                       (joint.axes[0].lower > -kUnlimited || joint.axes[0].upper < kUnlimited);
  return limited ? Answer::REVOLUTE : Answer::CONTINUOUS;
}

std::string get(Inbox& inbox, const GetJointProperties::Request& request, Answer& response) {
  const auto structure = structure_of(inbox);
  const sim::JointEntry& entry = joint_named(*structure, request.joint_name, kNoJoint);
  const desc::Joint& joint = structure->described(entry);
  response.type = type_of(joint);
  for (const desc::JointAxis& axis : joint.axes) response.damping.push_back(axis.damping);
  if (joint.axes.empty()) return "GetJointProperties: got properties";
  const sim::Observed seen = observe(inbox, {{}, {entry.name}});
  response.position = {seen.joints[0].position};
  response.rate = {seen.joints[0].velocity};
  return "GetJointProperties: got properties";
}

// Also a value that this solver does not use must be a number.
void check_unused(const ODEJointProperties& properties) {
  for (const auto* values : {&properties.erp, &properties.cfm, &properties.stop_erp,
                             &properties.stop_cfm, &properties.fudge_factor, &properties.vel}) {
    for (const double value : *values) {
      if (!std::isfinite(value)) throw Error("a property is not finite");
    }
  }
}

std::string set(Inbox& inbox, const SetJointProperties::Request& request,
                SetJointProperties::Response&) {
  const auto structure = structure_of(inbox);
  const ODEJointProperties& properties = request.ode_joint_config;
  sim::SetJointProperties to;
  to.joint = joint_named(*structure, request.joint_name, kNoJoint).name;
  check_unused(properties);
  to.damping = properties.damping;
  to.upper = properties.hiStop;
  to.lower = properties.loStop;
  if (!properties.fmax.empty()) {
    to.motor_force = properties.fmax[0];
    to.motor_velocity = properties.vel.empty() ? 0.0 : properties.vel[0];
  }
  edit(inbox, to);
  return "SetJointProperties: properties set";
}

std::string apply_effort(Inbox& inbox, const ApplyJointEffort::Request& request,
                         ApplyJointEffort::Response&) {
  const auto structure = structure_of(inbox);
  edit(inbox, sim::PushJoint{joint_named(*structure, request.joint_name, kNoJoint).name,
                             request.effort, push_time(request.start_time, request.duration)});
  return "ApplyJointEffort: effort set";
}

std::string clear_forces(Inbox& inbox, const JointRequest::Request& request,
                         JointRequest::Response&) {
  const auto structure = structure_of(inbox);
  edit(inbox, sim::ClearPushes{joint_named(*structure, request.joint_name, kNoJoint).name});
  return "";
}

}  // namespace

void serve_joints(Server& server) {
  server.serve<GetJointProperties>("GetJointProperties", &get);
  server.serve<SetJointProperties>("SetJointProperties", &set);
  server.serve<ApplyJointEffort>("ApplyJointEffort", &apply_effort);
  server.serve<JointRequest>("ClearJointForces", &clear_forces);
}

}  // namespace angen::node::gazebo

#include <gazebo_msgs/DeleteModel.h>
#include <gazebo_msgs/GetModelProperties.h>
#include <gazebo_msgs/GetModelState.h>
#include <gazebo_msgs/GetWorldProperties.h>
#include <gazebo_msgs/SetModelConfiguration.h>
#include <gazebo_msgs/SetModelState.h>
#include <ros/console.h>

#include <map>
#include <mutex>

#include "core/lists.h"
#include "core/named.h"
#include "core/names.h"
#include "core/text.h"
#include "gazebo/names.h"
#include "gazebo/services.h"
#include "gazebo/states.h"
#include "ros/convert.h"

namespace angen::node::gazebo {

namespace {

using namespace gazebo_msgs;

/// The number of requests for each model, which answers have in their header.
class Requests {
 public:
  std::uint32_t count(const std::string& model) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return ++counts_[model];
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::uint32_t> counts_;
};

std::string get_state(Inbox& inbox, Requests& requests, const GetModelState::Request& request,
                      GetModelState::Response& response) {
  const auto structure = structure_of(inbox);
  model_named(*structure, request.model_name);
  const std::string frame = frame_named(
      *structure, request.relative_entity_name,
      "reference relative_entity_name not found, did you forget to scope the body by model name?");
  const sim::Observed seen = observe(inbox, {{request.model_name, frame}, {}});
  const sim::Motion motion = relative(seen.entities[0], seen.entities[1]);
  response.header.seq = requests.count(request.model_name);
  response.header.stamp = to_ros(seen.time);
  response.header.frame_id = request.relative_entity_name;
  response.pose = to_ros(motion.pose);
  response.twist = twist_of(motion);
  return "GetModelState: got properties";
}

std::string get_model(Inbox& inbox, const GetModelProperties::Request& request,
                      GetModelProperties::Response& response) {
  const auto structure = structure_of(inbox);
  const desc::Model& model = *structure->models[model_named(*structure, request.model_name)];
  for (const desc::Link& link : model.links) {
    response.body_names.push_back(link.name);
    for (const desc::Collision& collision : link.collisions) {
      response.geom_names.push_back(collision.name);
    }
    const std::string child = link.name.substr(0, link.name.find("::"));
    std::vector<std::string>& children = response.child_model_names;
    const bool known = is_in(child, children);
    if (child != link.name && !known) children.push_back(child);
  }
  response.joint_names = names_in(model.joints);
  if (!model.links.empty()) response.canonical_body_name = model.links.front().name;
  response.is_static = static_cast<unsigned char>(model.is_static);
  return "GetModelProperties: got properties";
}

std::string get_world(Inbox& inbox, const GetWorldProperties::Request&,
                      GetWorldProperties::Response& response) {
  const auto snapshot = inbox.simulation().snapshot();
  response.sim_time = to_seconds(snapshot->time);
  response.model_names = names_in(snapshot->structure->models);
  response.rendering_enabled = 1;
  return "GetWorldProperties: got properties";
}

std::string configure(Inbox& inbox, const SetModelConfiguration::Request& request,
                      SetModelConfiguration::Response&) {
  if (request.joint_names.size() != request.joint_positions.size()) {
    throw Error("joint name and position list have different lengths");
  }
  // Names that the model lacks are passed over, as in Gazebo.
  const auto structure = structure_of(inbox);
  const desc::Model& model = *structure->models[model_named(*structure, request.model_name)];
  sim::SetJoints to{request.model_name, {}, {}};
  std::vector<std::string> unknown;
  for (std::size_t i = 0; i < request.joint_names.size(); ++i) {
    const std::string name = local_name(request.model_name, request.joint_names[i]);
    if (!index_in(model.joints, name)) {
      unknown.push_back(printable(name));
      continue;
    }
    to.joints.push_back(name);
    to.positions.push_back(request.joint_positions[i]);
  }
  if (!unknown.empty()) {
    ROS_WARN("set_model_configuration: %s has no joint '%s'%s", request.model_name.c_str(),
             unknown[0].c_str(),
             unknown.size() == 1
                 ? ""
                 : (" (and " + std::to_string(unknown.size() - 1) + " others)").c_str());
  }
  edit(inbox, to);
  return "SetModelConfiguration: success";
}

std::string set_state(Inbox& inbox, const SetModelState::Request& request,
                      SetModelState::Response&) {
  edit(inbox, edit_of(*structure_of(inbox), request.model_state));
  return "SetModelState: set model state done";
}

std::string erase(Inbox& inbox, const DeleteModel::Request& request, DeleteModel::Response&) {
  model_named(*structure_of(inbox), request.model_name);
  carry_out(inbox, sim::Delete{request.model_name});
  return "DeleteModel: successfully deleted model";
}

}  // namespace

sim::Edit edit_of(const sim::Structure& structure, const ModelState& state) {
  model_named(structure, state.model_name);
  const std::string frame = frame_named(structure, state.reference_frame,
                                        "specified reference frame entity does not exist");
  return sim::SetModelState{
      state.model_name,
      {frame, pose_of(state.pose), vector_of(state.twist.linear), vector_of(state.twist.angular)}};
}

void serve_models(Server& server) {
  const auto requests = std::make_shared<Requests>();
  server.serve<GetModelState>("GetModelState", [&, requests](const auto& request, auto& response) {
    return get_state(server.inbox(), *requests, request, response);
  });
  server.serve<GetModelProperties>("GetModelProperties", &get_model);
  server.serve<GetWorldProperties>("GetWorldProperties", &get_world);
  server.serve<SetModelState>("SetModelState", &set_state);
  server.serve<SetModelConfiguration>("SetModelConfiguration", &configure);
  server.serve<DeleteModel>("DeleteModel", &erase);
}

}  // namespace angen::node::gazebo

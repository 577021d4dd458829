#include "gazebo/spawn.h"

#include <gazebo_msgs/SpawnModel.h>

#include <algorithm>
#include <optional>

#include "core/named.h"
#include "core/names.h"
#include "core/text.h"
#include "document/packages.h"
#include "document/xml.h"
#include "gazebo/model_text.h"
#include "gazebo/names.h"
#include "ros/taken_topics.h"

namespace angen::node::gazebo {

namespace {

constexpr const char* kExists = "SpawnModel: Failure - entity already exists.";
constexpr const char* kNoUrdf = "SpawnModel: Failure - entity format is invalid.";
constexpr const char* kNoModel =
    "GazeboRosApiPlugin SpawnModel Failure: input model_xml not SDF or URDF, or cannot be "
    "converted "
    "to Gazebo compatible format.";

void check_format(const std::string& xml, bool urdf_only) {
  if (!valid_utf8(xml)) throw Error("model_xml is not UTF-8");
  try {
    load::check_text_size(xml);
    if (!is_urdf(xml) && urdf_only) throw Error("the root element is not <robot>");
  } catch (const Error& error) {
    throw Failed(std::string(urdf_only ? kNoUrdf : kNoModel) + " " + error.what());
  }
}

// A robot without its meshes is rejected, as by gazebo_ros.
void check_packages(const std::string& urdf, const load::SearchPaths& paths) {
  static const std::string kScheme = "package://";
  std::optional<load::Packages> known;
  for (std::size_t at = urdf.find(kScheme); at != std::string::npos;
       at = urdf.find(kScheme, at + 1)) {
    const std::size_t begin = at + kScheme.size();
    const std::size_t end = std::min(urdf.find_first_of("/\"'<> \t\r\n", begin), urdf.size());
    const std::string name = urdf.substr(begin, end - begin);
    if (!known) known.emplace(paths.packages);
    if (known->folder(name)) continue;
    throw Failed("urdf reference package name does not exist: " + printable(name));
  }
}

}  // namespace

Spawner::Spawner(Server& server, const load::SearchPaths& paths, Topics topics, Lights& lights)
    : inbox_(server.inbox()), paths_(paths), topics_(topics), lights_(lights) {
  for (const bool urdf_only : {true, false}) {
    const char* name = urdf_only ? "spawn_urdf_model" : "spawn_sdf_model";
    server.serve<gazebo_msgs::SpawnModel>(
        name, "SpawnModel", [this, urdf_only](const auto& request, auto&) {
          const auto structure = structure_of(inbox_);
          check_name(request.model_name);
          check_format(request.model_xml, urdf_only);
          if (urdf_only) check_packages(request.model_xml, paths_);
          const std::string frame =
              frame_named(*structure, request.reference_frame,
                          "reference reference_frame not found, did you forget to scope the link "
                          "by model name?");
          const std::string included = load::included_light(request.model_xml, paths_);
          const std::string& xml = included.empty() ? request.model_xml : included;
          const bool light = load::is_light(xml);
          if (light ? has_light(*structure, request.model_name)
                    : index_in(structure->models, request.model_name).has_value()) {
            throw Failed(kExists);
          }
          const ModelText text = model_text(xml, request.robot_namespace);
          const Pose given = pose_of(request.initial_pose);
          const Pose at = frame.empty() ? Pose() : observe(inbox_, {{frame}, {}}).entities[0].pose;
          const std::string said = carry_out(
              inbox_, action_of(text.xml, request.model_name, at * given * text.own_pose));
          if (light) lights_.note_spawned(request.model_name, text.xml);
          const std::size_t warnings = std::min(said.find('\n'), said.size());
          return "SpawnModel: Successfully spawned entity" + said.substr(warnings);
        });
  }
}

sim::Action Spawner::action_of(const std::string& xml, const std::string& name, const Pose& pose) {
  if (load::is_light(xml)) return sim::Edit(sim::AddLight{load::light(xml, name, pose), xml});
  sim::Spawn spawn{load::model(xml, name, pose, paths_, true)};
  const std::lock_guard<std::mutex> lock(mutex_);
  check_topics(new_sensors(spawn.model), catalog_, topics_);
  return spawn;
}

}  // namespace angen::node::gazebo

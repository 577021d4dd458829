#include "record/world_file.h"

#include <unordered_map>
#include <vector>

#include "sdf/load.h"

namespace angen::record {

namespace {

constexpr double kSame = 1e-7;  // m, rad: a static model that nobody has put elsewhere

bool is_at(const Pose& pose, const Pose& other) {
  return (pose.position - other.position).norm() < kSame &&
         pose.rotation.angularDistance(other.rotation) < kSame;
}

// The world's own; those of models are added to their states.
std::vector<load::LightState> lights_of(const sim::SavedState& state,
                                        std::vector<load::ModelState>& models) {
  const sim::Structure& all = *state.snapshot->structure;
  std::vector<load::LightState> own;
  for (const sim::LightEntry& entry : all.lights) {
    if (entry.model == UINT32_MAX) own.push_back({&entry.light});
  }
  for (const sim::SavedLight& saved : state.lights) {
    const sim::LightEntry& entry = all.lights[saved.light];
    if (entry.model == UINT32_MAX) {
      own[saved.light].lamp = saved.lamp;
      own[saved.light].sdf = saved.sdf;
      continue;
    }
    const std::string& name = all.described(all.links[entry.link]).name;
    models[entry.model].lights.push_back({&entry.light, name, saved.lamp});
  }
  return own;
}

}  // namespace

std::string world_file(const desc::World& settings, const sim::SavedState& state) {
  const sim::Snapshot& snapshot = *state.snapshot;
  const sim::Structure& all = *snapshot.structure;
  std::vector<load::ModelState> states;
  for (const auto& model : all.models) states.push_back({model.get(), model->pose, {}});
  for (std::size_t i = 0; i < all.links.size(); ++i) {
    const sim::LinkEntry& link = all.links[i];
    if (link.link != 0) continue;
    const Pose& rest = all.models[link.model]->links.front().pose;
    if (!link.moves && is_at(snapshot.link_poses[i], states[link.model].pose * rest)) continue;
    states[link.model].pose = snapshot.link_poses[i] * rest.inverse();
  }
  for (std::size_t i = 0; i < all.joints.size(); ++i) {
    const sim::JointEntry& joint = all.joints[i];
    const desc::Joint& described = all.described(joint);
    if (described.axes.size() != 1) continue;
    states[joint.model].joint_positions.push_back({described.name, {snapshot.joint_positions[i]}});
  }
  for (const sim::SensorEntry& sensor : all.sensors) {
    if (!sensor.attached) continue;
    const std::string& name = all.described(all.links[sensor.link]).name;
    states[sensor.model].attached.push_back({name, *sensor.desc});
  }
  std::unordered_map<std::string, load::ModelState*> by_name;
  for (load::ModelState& model : states) by_name[model.model->name] = &model;
  for (const sim::SavedPlugin& saved : state.plugins) {
    const auto model = by_name.find(saved.model);
    if (model != by_name.end()) model->second->plugins.push_back(saved.plugin);
  }
  for (const sim::ChangedModel& changed : state.changed) {
    states[changed.model].read = changed.read.get();
  }
  return load::save(settings, states, {all.physics, all.gravity, lights_of(state, states)});
}

}  // namespace angen::record

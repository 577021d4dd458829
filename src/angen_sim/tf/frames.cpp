#include "tf/frames.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/union_find.h"
#include "ros/topics.h"
#include "ros/wire.h"

namespace angen::node {
namespace {

// Links that fixed joints hold together, by the smallest index of each group; 0 is the world.
class Clusters {
 public:
  explicit Clusters(const desc::Model& model) : groups_(model.links.size() + 1) {
    std::map<std::string, std::uint32_t> by_name;
    for (std::uint32_t i = 0; i < model.links.size(); ++i) {
      by_name[model.links[i].name] = i + 1;
      if (model.is_static) groups_.join(i + 1, 0);
    }
    for (const desc::Joint& joint : model.joints) {
      if (joint.type != desc::Joint::Type::kFixed) continue;
      const auto child = by_name.find(joint.child);
      const auto parent = by_name.find(joint.parent);
      if (child == by_name.end()) continue;
      if (parent == by_name.end() && joint.parent != kWorldFrame) continue;
      groups_.join(child->second, joint.parent == kWorldFrame ? 0 : parent->second);
    }
  }

  bool in_world(std::uint32_t link) { return groups_.root(link + 1) == 0; }
  std::uint32_t first(std::uint32_t link) { return groups_.root(link + 1) - 1; }

 private:
  UnionFind groups_;
};

class LinkFrames {
 public:
  LinkFrames(const desc::Model& model, const std::string& base_frame, std::uint32_t base)
      : model_(model), clusters_(model) {
    frames_.base_frame = base_frame;
    frames_.base = base;
    for (const desc::Link& link : model.links)
      frames_.links.push_back(model.name + "/" + link.name);
    if (is_robot()) frames_.links[base] = base_frame;
    frames_.moved_by.assign(model.links.size(), -1);
  }

  ModelFrames build() {
    for (std::uint32_t i = 0; i < model_.links.size(); ++i) add(i);
    return std::move(frames_);
  }

 private:
  bool is_robot() const { return !frames_.base_frame.empty(); }

  // The link whose frame represents the cluster: a robot's base, else the first.
  std::uint32_t head(std::uint32_t link) {
    const std::uint32_t first = clusters_.first(link);
    return is_robot() && clusters_.first(frames_.base) == first ? frames_.base : first;
  }

  void add(std::uint32_t link) {
    const std::string& frame = frames_.links[link];
    if (clusters_.in_world(link)) {
      frames_.standing.push_back({frames_.fixed.size(), link});
      frames_.fixed.push_back({kWorldFrame, frame, Pose{}});
      return;
    }
    const std::uint32_t top = head(link);
    const bool is_base = is_robot() && frames_.base == top;
    if (!is_base && carrier_.count(top) == 0) {
      MovingFrame moving{kWorldFrame, frames_.links[top], top, {}};
      if (is_robot()) {
        moving.parent = frames_.base_frame;
        moving.parent_link = frames_.base;
      }
      carrier_[top] = static_cast<std::int32_t>(frames_.moving.size());
      frames_.moving.push_back(std::move(moving));
    }
    if (!is_base) frames_.moved_by[link] = carrier_[top];
    if (link == top) return;
    const Pose in_top = model_.links[top].pose.inverse() * model_.links[link].pose;
    frames_.fixed.push_back({frames_.links[top], frame, in_top});
  }

  const desc::Model& model_;
  Clusters clusters_;
  ModelFrames frames_;
  std::map<std::uint32_t, std::int32_t> carrier_;  // cluster's frame link -> index in moving
};

// REP 103: images are seen along z, with x to the right.
const Quat kOptical = from_rpy(-M_PI_2, 0.0, -M_PI_2);

// The frame that a robot made for Gazebo knows, whose place it publishes itself; none for others.
std::optional<std::string> foreign_frame(const RosKind& kind, const sim::SensorEntry& sensor,
                                         const desc::Model& model) {
  if (kind.frame) return kind.frame(sensor);
  if (sensor.frame.empty() || !model.customs.keeps_frames) return std::nullopt;
  return sensor.frame;
}

// A frame that begins with / has no prefix, and no frame begins with / in the end, as in tf.
std::string resolved(const std::string& prefix, const std::string& frame) {
  if (!frame.empty() && frame[0] == '/') return frame.substr(1);
  return prefix.empty() || frame.empty() ? frame : prefix + "/" + frame;
}

// The namespace that the first plug-in of a robot names; none if it has no plug-in.
std::optional<std::string> space_of(const desc::Model& model) {
  std::vector<const Element*> plugins;
  for (const desc::Plugin& plugin : model.plugins) plugins.push_back(&plugin.element);
  for (const desc::Link& link : model.links) {
    for (const desc::Sensor& sensor : link.sensors) plugins.push_back(&sensor.plugin_element);
  }
  if (plugins.empty()) return std::nullopt;
  for (const Element* plugin : plugins) {
    if (const Element* space = namespace_of(*plugin)) return space->text;
  }
  return "";
}

// A model with several drives has the frames of the last.
const Robot* owner_in(const std::vector<Robot>& robots, std::uint32_t model) {
  const Robot* owner = nullptr;
  for (const Robot& robot : robots) {
    if (robot.model == model) owner = &robot;
  }
  return owner;
}

}  // namespace

ModelFrames frames_of(const desc::Model& model, const std::string& base_frame, std::uint32_t base) {
  return LinkFrames(model, base_frame, base).build();
}

std::shared_ptr<const FrameTree> FrameMaker::make(const sim::Snapshot& snapshot,
                                                  const std::vector<Robot>& robots,
                                                  const Changes& changes) {
  const sim::Structure& structure = *snapshot.structure;
  auto tree = tree_ ? std::make_shared<FrameTree>(*tree_) : std::make_shared<FrameTree>();
  const std::size_t kept = keep_models(structure, robots, changes);
  add_links(snapshot, kept, *tree);
  const std::size_t first = keep_sensors(structure, kept, changes, *tree);
  for (std::size_t i = first; i < structure.sensors.size(); ++i) {
    const Robot* owner = owner_in(robots, structure.sensors[i].model);
    add_sensor(structure, static_cast<std::uint32_t>(i), owner, *tree);
  }
  add_odometry(structure, robots, *tree);
  tree_ = tree;
  return tree;
}

void FrameMaker::drop(const std::shared_ptr<const ModelFrames>& model) {
  if (model == nullptr) return;
  for (const std::string& frame : model->links) {
    if (--link_frames_[frame] == 0) link_frames_.erase(frame);
  }
}

// Our own robots have their name for a prefix, or none.
std::string FrameMaker::prefix_of(const desc::Model& model) const {
  const std::optional<std::string> space = space_of(model);
  return model.customs.keeps_frames && space && prefix_in_ ? resolved("", prefix_in_(*space)) : "";
}

std::size_t FrameMaker::keep_models(const sim::Structure& structure,
                                    const std::vector<Robot>& robots, const Changes& changes) {
  std::vector<std::shared_ptr<const ModelFrames>> old = std::exchange(models_, {});
  std::vector<std::string> prefixes = std::exchange(prefixes_, {});
  models_.resize(structure.models.size());
  prefixes_.resize(models_.size());
  std::size_t kept = models_.size();
  for (std::uint32_t i = 0; i < models_.size(); ++i) {
    const std::uint32_t before = changes.models.before[i];
    if (before != Numbers::kNone) models_[i] = std::move(old[before]);
    prefixes_[i] =
        before != Numbers::kNone ? std::move(prefixes[before]) : prefix_of(*structure.models[i]);
    if (before != i) kept = std::min<std::size_t>(kept, i);
    const Robot* robot = owner_in(robots, i);
    const std::string base_frame = robot == nullptr ? "" : robot->base_frame;
    const std::uint32_t base = robot == nullptr ? 0 : structure.links[robot->base].link;
    if (models_[i] && models_[i]->base_frame == base_frame && models_[i]->base == base) continue;
    kept = std::min<std::size_t>(kept, i);
    drop(models_[i]);
    models_[i] =
        std::make_shared<const ModelFrames>(frames_of(*structure.models[i], base_frame, base));
    for (const std::string& frame : models_[i]->links) ++link_frames_[frame];
  }
  for (const auto& model : old) drop(model);
  return kept;
}

void FrameMaker::add_links(const sim::Snapshot& snapshot, std::size_t kept, FrameTree& tree) const {
  std::uint32_t first = 0;  // the model's first, in Structure::links
  std::size_t fixed = 0, moving = 0;
  const auto place = [&](const ModelFrames& model) {
    for (const ModelFrames::Standing& standing : model.standing) {
      const FixedFrame& frame = tree.fixed[fixed + standing.fixed];
      const Pose& pose = snapshot.link_poses[first + standing.link];
      if (frame.pose == pose) continue;
      tree.fixed.set(fixed + standing.fixed, {frame.parent, frame.child, pose});
    }
  };
  const auto pass = [&](const ModelFrames& model) {
    first += static_cast<std::uint32_t>(model.links.size());
    fixed += model.fixed.size();
    moving += model.moving.size();
  };
  for (std::size_t i = 0; i < kept; ++i) {
    place(*models_[i]);
    pass(*models_[i]);
  }
  tree.fixed.truncate(fixed);
  tree.moving.truncate(moving);
  tree.moved_by.truncate(first);
  for (std::size_t i = kept; i < models_.size(); ++i) {
    const ModelFrames& model = *models_[i];
    for (const FixedFrame& frame : model.fixed) tree.fixed.push_back(frame);
    for (MovingFrame frame : model.moving) {
      frame.link += first;
      if (frame.parent_link) *frame.parent_link += first;
      tree.moving.push_back(std::move(frame));
    }
    for (const std::int32_t by : model.moved_by) {
      tree.moved_by.push_back(by < 0 ? by : static_cast<std::int32_t>(moving) + by);
    }
    place(model);
    pass(model);
  }
}

// Odometry starts at 0 where its robot was put; a true one says where in the world it is.
void FrameMaker::add_odometry(const sim::Structure& structure, const std::vector<Robot>& robots,
                              FrameTree& tree) const {
  tree.odometry.clear();
  if (!odometry_in_world_) return;
  std::set<std::string> added;
  for (std::size_t i = 0; i < mounted_.size(); ++i) {
    if (!mounted_[i].is_odometry) continue;
    const sim::SensorEntry& sensor = structure.sensors[i];
    const RosKind& kind = ros_kind(sensor);
    const std::string frame = resolved(prefixes_[sensor.model], kind.frame(sensor));
    if (!added.insert(frame).second) continue;
    const bool at_model = kind.odometry(sensor).starts_at_model;
    tree.odometry.push_back(
        {kWorldFrame, frame, at_model ? structure.models[sensor.model]->pose : Pose{}});
  }
  for (const Robot& robot : robots) {
    if (owner_in(robots, robot.model) != &robot) continue;
    const sim::LinkEntry& base = structure.links[robot.base];
    const desc::Model& model = *structure.models[robot.model];
    tree.odometry.push_back(
        {kWorldFrame, robot.odom_frame, model.pose * model.links[base.link].pose});
  }
}

// The first sensors keep their frames, unless that of another link or sensor decides about one.
std::size_t FrameMaker::keep_sensors(const sim::Structure& structure, std::size_t models,
                                     const Changes& changes, FrameTree& tree) {
  std::size_t kept = 0;
  const auto stays = [&](std::size_t i) {
    return changes.sensors.before[i] == i && structure.sensors[i].model < models;
  };
  if (!other_names_) {
    while (kept < structure.sensors.size() && stays(kept)) ++kept;
  }
  const auto is_taken = [&](const std::string& frame) { return sensor_frames_.count(frame) != 0; };
  for (std::size_t i = models; i < models_.size(); ++i) {
    if (std::any_of(models_[i]->links.begin(), models_[i]->links.end(), is_taken)) kept = 0;
  }
  for (std::size_t i = kept; i < mounted_.size(); ++i) {
    if (mounted_[i].takes_frame) sensor_frames_.erase(tree.sensors[i]);
  }
  tree.mounts.truncate(kept < mounted_.size() ? mounted_[kept].mount : tree.mounts.size());
  tree.sensors.truncate(kept);
  tree.bases.truncate(kept);
  mounted_.resize(kept);
  if (kept == 0) other_names_ = false;
  return kept;
}

bool FrameMaker::take(const std::string& frame) {
  return link_frames_.count(frame) == 0 && sensor_frames_.insert(frame).second;
}

void FrameMaker::add_sensor(const sim::Structure& structure, std::uint32_t number,
                            const Robot* owner, FrameTree& tree) {
  const sim::SensorEntry& sensor = structure.sensors[number];
  const sim::LinkEntry& link = structure.links[sensor.link];
  const RosKind& kind = ros_kind(sensor);
  const bool is_odometry = kind.odometry != nullptr;
  Mounted mounted{static_cast<std::uint32_t>(tree.mounts.size()), false, is_odometry};
  std::string base;
  if (const auto foreign = foreign_frame(kind, sensor, *structure.models[sensor.model])) {
    const std::string& prefix = prefixes_[sensor.model];
    tree.sensors.push_back(resolved(prefix, *foreign));
    if (is_odometry) base = resolved(prefix, kind.odometry(sensor).base);
  } else {
    const std::string frame = own_frame(sensor, kind, owner, frame_of(link), mounted.takes_frame);
    if (frame != frame_of(link)) {  // an SDF that names its link's frame means it
      const Pose in_sensor = kind.is_camera ? Pose{Vec3::Zero(), kOptical} : Pose{};
      tree.mounts.push_back({frame_of(link), frame, sensor.pose * in_sensor});
    }
    tree.sensors.push_back(frame);
  }
  if (kind.truth) {  // the name in the file, without a prefix
    base = kind.truth(sensor);
    if (base.empty()) base = frame_of(link);
  }
  tree.bases.push_back(std::move(base));
  mounted_.push_back(mounted);
}

std::string FrameMaker::own_frame(const sim::SensorEntry& sensor, const RosKind& kind,
                                  const Robot* owner, const std::string& link_frame,
                                  bool& is_taken) {
  std::string frame = sensor.frame;
  if (frame.empty()) frame = sensor.name + (kind.is_camera ? "_optical_frame" : "");
  if (owner != nullptr && !owner->first && !sensor.frame.empty()) {
    frame.insert(0, 1, '/').insert(0, owner->name);
  }
  if (frame == link_frame) return frame;
  is_taken = take(frame);
  if (is_taken) return frame;
  other_names_ = true;
  frame = sensor.kind + "_" + sensor.name;
  is_taken = take(frame);
  return frame;
}

}  // namespace angen::node

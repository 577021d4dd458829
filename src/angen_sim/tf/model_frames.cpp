#include "tf/model_frames.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace angen::node {
namespace {

// Links that fixed joints hold together, by the smallest index of each group; 0 is the world.
class Clusters {
 public:
  explicit Clusters(const desc::Model& model) : parent_(model.links.size() + 1) {
    std::iota(parent_.begin(), parent_.end(), 0U);
    std::map<std::string, std::uint32_t> by_name;
    for (std::uint32_t i = 0; i < model.links.size(); ++i) {
      by_name[model.links[i].name] = i + 1;
      if (model.is_static) join(i + 1, 0);
    }
    for (const desc::Joint& joint : model.joints) {
      if (joint.type != desc::Joint::Type::kFixed) continue;
      const auto child = by_name.find(joint.child);
      const auto parent = by_name.find(joint.parent);
      if (child == by_name.end()) continue;
      if (parent == by_name.end() && joint.parent != kWorldFrame) continue;
      join(child->second, joint.parent == kWorldFrame ? 0 : parent->second);
    }
  }

  bool in_world(std::uint32_t link) { return root(link + 1) == 0; }
  std::uint32_t first(std::uint32_t link) { return root(link + 1) - 1; }

 private:
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  std::vector<std::uint32_t> parent_;
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

}  // namespace

ModelFrames frames_of(const desc::Model& model, const std::string& base_frame, std::uint32_t base) {
  return LinkFrames(model, base_frame, base).build();
}

}  // namespace angen::node

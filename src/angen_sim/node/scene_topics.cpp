#include "node/scene_topics.h"

#include <chrono>
#include <limits>

#include "node/scene_message.h"
#include "ros/convert.h"

namespace angen::node {
namespace {

constexpr std::chrono::milliseconds kScenePeriod(50);

void append_pose(const Pose& pose, std::vector<float>& out) {
  const Vec3& p = pose.position;
  const Quat& q = pose.rotation;
  for (const double v : {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()}) {
    out.push_back(static_cast<float>(v));
  }
}

}  // namespace

SceneTopics::SceneTopics(ros::NodeHandle& node)
    : scene_(node, "angen/scene", 4),
      changes_(LazyPublisher::of<angen_msgs::SceneChanges>(node, "angen/scene_changes", 40)) {}

void SceneTopics::mark(std::uint32_t link) {
  if (marked_[link]) return;
  marked_[link] = true;
  moved_.push_back(link);
}

void SceneTopics::mark_all(const sim::Snapshot& snapshot) {
  const sim::Structure& structure = *snapshot.structure;
  moved_.clear();
  marked_.assign(structure.links.size(), false);
  for (std::uint32_t i = 0; i < structure.links.size(); ++i) {
    if (structure.links[i].moves) mark(i);
  }
  levels_.assign(structure.lights.size(), std::numeric_limits<double>::quiet_NaN());
}

void SceneTopics::add_levels(const sim::Snapshot& snapshot, angen_msgs::SceneChanges& changes) {
  const std::vector<double>& now = *snapshot.light_levels;
  for (std::uint32_t i = 0; i < now.size(); ++i) {
    if (now[i] == levels_[i]) continue;
    levels_[i] = now[i];
    changes.lights.push_back(i);
    changes.levels.push_back(static_cast<float>(now[i]));
  }
}

void SceneTopics::publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now) {
  const bool is_other = snapshot.structure != structure_;
  if (is_other) {
    structure_ = snapshot.structure;
    scene_.set([structure = structure_, poses = snapshot.link_poses] {
      return scene_message(*structure, poses);
    });
  }
  const bool listened = changes_.has_subscribers();
  const std::uint64_t joined = changes_.subscriptions();
  if (listened && (is_other || !listened_ || joined != joined_)) mark_all(snapshot);
  listened_ = listened;
  if (!listened) return;
  joined_ = joined;
  for (const std::uint32_t link : snapshot.moved_links) mark(link);
  if (now < next_) return;
  next_ = now + kScenePeriod;
  angen_msgs::SceneChanges changes;
  add_levels(snapshot, changes);
  if (moved_.empty() && changes.lights.empty()) return;
  changes.header.stamp = to_ros(snapshot.time);
  changes.revision = snapshot.structure->revision;
  changes.poses.reserve(moved_.size() * 7);
  for (const std::uint32_t link : moved_) {
    append_pose(snapshot.link_poses[link], changes.poses);
    marked_[link] = false;
  }
  changes.links = std::move(moved_);
  moved_.clear();
  changes_.publish([&]() -> const angen_msgs::SceneChanges& { return changes; });
}

}  // namespace angen::node

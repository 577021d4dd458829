#include "ros/tf.h"

#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "ros/convert.h"
#include "ros/kinds/states.h"

namespace angen::node {
namespace {

constexpr Nanoseconds kTransformPeriod = kSecond / 50;

void add(tf2_msgs::TFMessage& message, Nanoseconds time, const std::string& parent,
         const std::string& child, const Pose& pose) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = to_ros(time);
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  transform.transform = to_transform(pose);
  message.transforms.push_back(std::move(transform));
}

/// Whether `now` has a frame that differs from `before`. tf listeners keep frames that are gone.
bool has_new_frames(const std::vector<FixedFrame>& before, const std::vector<FixedFrame>& now) {
  std::unordered_map<std::string, const FixedFrame*> known;
  for (const FixedFrame& frame : before) known[frame.child] = &frame;
  return std::any_of(now.begin(), now.end(), [&](const FixedFrame& frame) {
    const auto found = known.find(frame.child);
    return found == known.end() || found->second->parent != frame.parent ||
           !(found->second->pose == frame.pose);
  });
}

}  // namespace

Transforms::Transforms(ros::NodeHandle& node)
    : fixed_(node, "/tf_static", 10),
      moving_(LazyPublisher::of<tf2_msgs::TFMessage>(node, "/tf", 100)) {}

void Transforms::on_structure(const sim::Snapshot& snapshot, const FrameTree& frames,
                              const std::vector<Robot>& robots) {
  const std::vector<FixedFrame> before = std::exchange(frames_.fixed, {});
  frames_ = frames;
  robots_ = robots;
  moved_.clear();
  marked_.assign(frames_.moving.size(), false);
  const bool is_news = has_new_frames(before, frames_.fixed);
  fixed_.set(
      [fixed = std::make_shared<const std::vector<FixedFrame>>(frames_.fixed),
       time = snapshot.time] {
        tf2_msgs::TFMessage message;
        for (const FixedFrame& frame : *fixed) {
          add(message, time, frame.parent, frame.child, frame.pose);
        }
        return message;
      },
      is_news);
  new_structure_ = true;
}

void Transforms::publish(const sim::Snapshot& snapshot) {
  for (const std::uint32_t link : snapshot.moved_links) {
    const std::int32_t frame = frames_.moved_by[link];
    if (frame < 0 || marked_[frame]) continue;
    marked_[frame] = true;
    moved_.push_back(static_cast<std::uint32_t>(frame));
  }
  const std::uint64_t joined = moving_.subscriptions();
  const bool newcomer = joined != joined_;
  const Nanoseconds slot = snapshot.time / kTransformPeriod;
  if (slot == slot_ && !new_structure_ && !(newcomer && snapshot.paused)) return;
  const Nanoseconds second = snapshot.time / kSecond;
  const bool all = newcomer || new_structure_ || second != second_;
  joined_ = joined;
  slot_ = slot;
  second_ = second;
  new_structure_ = false;
  if (moving_.has_subscribers()) {
    const tf2_msgs::TFMessage message = collect(snapshot, all, newcomer);
    if (!message.transforms.empty()) moving_.publish([&]() -> const auto& { return message; });
  }
  for (const std::uint32_t frame : moved_) marked_[frame] = false;
  moved_.clear();
}

tf2_msgs::TFMessage Transforms::collect(const sim::Snapshot& snapshot, bool all, bool again) {
  tf2_msgs::TFMessage message;
  if (again || snapshot.time != sent_at_) sent_.clear();
  sent_at_ = snapshot.time;
  const auto is_due = [&](const std::string& child) { return sent_.insert(child).second; };
  const auto add_moving = [&](const MovingFrame& frame) {
    if (!is_due(frame.child)) return;
    Pose pose = snapshot.link_poses[frame.link];
    if (frame.parent_link) pose = snapshot.link_poses[*frame.parent_link].inverse() * pose;
    add(message, snapshot.time, frame.parent, frame.child, pose);
  };
  if (all) {
    for (const MovingFrame& frame : frames_.moving) add_moving(frame);
  } else {
    for (const std::uint32_t frame : moved_) add_moving(frames_.moving[frame]);
  }
  for (const Robot& robot : robots_) {
    if (snapshot.devices[robot.device] == nullptr || !is_due(robot.base_frame)) continue;
    add(message, snapshot.time, robot.odom_frame, robot.base_frame,
        odometry_pose(*snapshot.devices[robot.device]));
  }
  return message;
}

}  // namespace angen::node

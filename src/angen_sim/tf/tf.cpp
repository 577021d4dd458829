#include "tf/tf.h"

#include <algorithm>
#include <utility>

#include "ros/convert.h"
#include "ros/kinds/states.h"
#include "ros/pacer.h"

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

void add(tf2_msgs::TFMessage& message, Nanoseconds time, const FixedFrame& frame) {
  add(message, time, frame.parent, frame.child, frame.pose);
}

/// Adds frames of `now` that `before` lacks; frames that stay keep their order. tf listeners
/// keep removed frames.
template <class Frames>
void add_new(tf2_msgs::TFMessage& message, Nanoseconds time, const Frames& before,
             const Frames& now) {
  auto next = before.begin();
  for (const FixedFrame& frame : now) {
    const auto same = [&](const FixedFrame& old) { return &old == &frame || old == frame; };
    const auto found = std::find_if(next, before.end(), same);
    if (found == before.end()) {
      add(message, time, frame);
    } else {
      next = std::next(found);
    }
  }
}

tf2_msgs::TFMessage new_in(const FrameTree& before, const FrameTree& now, Nanoseconds time) {
  tf2_msgs::TFMessage message;
  add_new(message, time, before.fixed, now.fixed);
  add_new(message, time, before.odometry, now.odometry);
  add_new(message, time, before.mounts, now.mounts);
  return message;
}

tf2_msgs::TFMessage fixed_of(const FrameTree& tree, Nanoseconds time) {
  tf2_msgs::TFMessage message;
  message.transforms.reserve(tree.fixed_count());
  for (const FixedFrame& frame : tree.fixed) add(message, time, frame);
  for (const FixedFrame& frame : tree.odometry) add(message, time, frame);
  for (const FixedFrame& frame : tree.mounts) add(message, time, frame);
  return message;
}

bool same_frames(const std::vector<Robot>& a, const std::vector<Robot>& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(), [](const Robot& one, const Robot& other) {
        return one.odom_frame == other.odom_frame && one.base_frame == other.base_frame;
      });
}

}  // namespace

Transforms::Transforms(ros::NodeHandle& node)
    : fixed_(node, "tf_static", 10),
      moving_(LazyPublisher::of<tf2_msgs::TFMessage>(node, "tf", 100)) {}

void Transforms::on_structure(const sim::Snapshot& snapshot,
                              std::shared_ptr<const FrameTree> frames,
                              const std::vector<Robot>& robots, const Changes& changes) {
  const std::shared_ptr<const FrameTree> before = std::exchange(frames_, std::move(frames));
  const std::vector<std::uint32_t> moved = std::exchange(moved_, {});
  marked_.assign(frames_->moving.size(), false);
  for (const std::uint32_t frame : moved) {
    const std::uint32_t link = changes.links.after[before->moving[frame].link];
    if (link != Numbers::kNone) mark(frames_->moved_by[link]);
  }
  for (std::size_t i = 0; i < frames_->moving.size(); ++i) {
    const bool is_new = changes.links.before[frames_->moving[i].link] == Numbers::kNone;
    if (is_new) mark(static_cast<std::int32_t>(i));
  }
  fix(snapshot.time, before.get());
  new_structure_ = true;
  new_robots_ = new_robots_ || !same_frames(robots_, robots);
  robots_ = robots;
}

bool Transforms::whole_is_due() const { return Pacer::Clock::now() - whole_sent_ >= kWallSecond; }

void Transforms::fix(Nanoseconds now, const FrameTree* before) {
  tf2_msgs::TFMessage news;
  if (before != nullptr) news = new_in(*before, *frames_, now);
  const bool is_news = before == nullptr || !news.transforms.empty();
  const bool whole = is_news && whole_is_due();
  fixed_.set([made = frames_, now] { return fixed_of(*made, now); }, whole);
  if (whole) {
    whole_sent_ = Pacer::Clock::now();
    whole_waits_ = false;
  } else if (is_news) {
    fixed_.publish([&]() -> const auto& { return news; });
    whole_waits_ = true;
  }
}

void Transforms::send_whole() {
  if (!whole_waits_ || !whole_is_due()) return;
  whole_waits_ = false;
  whole_sent_ = Pacer::Clock::now();
  fixed_.repeat();
}

void Transforms::mark(std::int32_t frame) {
  if (frame < 0 || marked_[frame]) return;
  marked_[frame] = true;
  moved_.push_back(static_cast<std::uint32_t>(frame));
}

void Transforms::publish(const sim::Snapshot& snapshot) {
  send_whole();
  for (const std::uint32_t link : snapshot.moved_links) mark(frames_->moved_by[link]);
  const std::uint64_t joined = moving_.subscriptions();
  const bool newcomer = joined != joined_;
  const Nanoseconds slot = snapshot.time / kTransformPeriod;
  if (slot == slot_ && !new_structure_ && !(newcomer && snapshot.paused)) return;
  const Nanoseconds second = snapshot.time / kSecond;
  const bool all = newcomer || new_robots_ || second != second_;
  joined_ = joined;
  slot_ = slot;
  second_ = second;
  new_structure_ = new_robots_ = false;
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
    for (const MovingFrame& frame : frames_->moving) add_moving(frame);
  } else {
    for (const std::uint32_t frame : moved_) add_moving(frames_->moving[frame]);
  }
  for (const Robot& robot : robots_) {
    if (snapshot.devices[robot.device] == nullptr || !is_due(robot.base_frame)) continue;
    add(message, snapshot.time, robot.odom_frame, robot.base_frame,
        odometry_pose(*snapshot.devices[robot.device]));
  }
  return message;
}

}  // namespace angen::node

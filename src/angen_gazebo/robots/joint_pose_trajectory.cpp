// libgazebo_ros_joint_pose_trajectory.so
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/text.h"
#include "plugin/outputs.h"
#include "plugin/registration.h"
#include "plugin/view.h"
#include "plugin/wiring.h"
#include "robots/base.h"

namespace angen::robots {

namespace {

struct Point {
  double time = 0.0;              // s from the start
  std::vector<double> positions;  // rad or m
};

}  // namespace

/// Leads joints along a trajectory. A command's text has the joints' names, with blanks between;
/// its values have the time to start (s; past: at once), then for each point its time from the
/// start and the position of each joint.
class JointPoseTrajectory : public Device {
 public:
  void configure(Params& params, Wiring& wiring) override {
    params.text("topicName", "set_joint_trajectory", "where trajectories come from");
    params.text("serviceName", "set_joint_trajectory",
                "not used: Gazebo's source leaves its service out, too");
    for (const std::string& name : wiring.joint_names()) {
      const JointRef joint = wiring.joint(name);
      if (!wiring.is_fixed(joint)) known_.emplace_back(name, joint);
    }
  }

  Verdict command(const Command& command, const View& view) override {
    const std::vector<std::string> names = words_in(command.text);
    std::vector<JointRef> joints;
    for (const std::string& name : names) {
      const auto found = std::find_if(known_.begin(), known_.end(),
                                      [&](const auto& each) { return each.first == name; });
      if (found == known_.end()) return Verdict::reject("no joint '" + name + "' that moves");
      joints.push_back(found->second);
    }
    std::vector<Point> points;
    const std::string problem = read_points(command.values, names.size(), points);
    if (!problem.empty()) return Verdict::reject(problem);
    const double now = to_seconds(view.time());
    return Verdict::accept([this, joints, points, start = std::max(now, command.values[0])] {
      joints_ = joints;
      points_ = points;
      began_.clear();
      start_ = start;
    });
  }

  void update(const View& view, Outputs& outputs) override {
    if (points_.empty()) return;
    const double step = to_seconds(view.step());
    const double time = to_seconds(view.time()) - start_;
    if (began_.size() != joints_.size() || time <= 0.0) note_begin(view);
    const bool done = time > points_.back().time + kSettles;
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const double target = position_at(time, i);
      const double ahead = (position_at(time + step, i) - target) / step;
      const double left = target - view.joint(joints_[i]).position;
      outputs.motor(joints_[i], done ? 0.0 : ahead + left / kResponse, kMax);
    }
    if (done) points_.clear();
  }

  Nanoseconds idle_until(const View&) const override { return points_.empty() ? kForever : 0; }

  void report(const View&, Reading& state) const override {
    state.set("follows", !points_.empty());
  }

 private:
  static constexpr double kResponse = 0.02;  // s, in which an error is made up but for a third
  static constexpr double kSettles = 0.2;    // s, after the last point
  static constexpr double kMax = std::numeric_limits<double>::infinity();

  static std::string read_points(const std::vector<double>& values, std::size_t joints,
                                 std::vector<Point>& points) {
    if (joints == 0) return "a trajectory names its joints; this one names none";
    const std::size_t each = joints + 1;
    if (values.size() < 1 + each || (values.size() - 1) % each != 0) {
      return "a trajectory of " + std::to_string(joints) + " joints has a time and " +
             std::to_string(joints) + " positions for each point, at least once";
    }
    for (std::size_t at = 1; at < values.size(); at += each) {
      Point point{values[at], {}};
      for (std::size_t i = 1; i < each; ++i) point.positions.push_back(values[at + i]);
      if (!points.empty() && point.time < points.back().time) return "its times do not ascend";
      points.push_back(std::move(point));
    }
    const bool finite =
        std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    return finite && points.front().time >= 0.0 ? ""
                                                : "it has a number that is not finite, or a "
                                                  "negative time";
  }

  // Positions of the joints at the start, from which the first point is reached.
  void note_begin(const View& view) {
    began_.clear();
    for (const JointRef joint : joints_) began_.push_back(view.joint(joint).position);
  }

  double position_at(double time, std::size_t joint) const {
    double before_time = 0.0;
    double before = began_[joint];
    for (const Point& point : points_) {
      if (time < point.time) {
        const double share = std::max(0.0, time - before_time) / (point.time - before_time);
        return before + share * (point.positions[joint] - before);
      }
      before_time = point.time;
      before = point.positions[joint];
    }
    return before;
  }

  std::vector<std::pair<std::string, JointRef>> known_;
  std::vector<JointRef> joints_;
  std::vector<Point> points_;  // none: it does nothing
  std::vector<double> began_;
  double start_ = 0.0;  // s
};

class JointPoseTrajectoryPlugin : public Plugin {
 public:
  ANGEN_DESCRIBED_AS(Kind("joint_trajectory", "Leads a robot's joints along a trajectory.")
                         .flag("follows", "it is under way")
                         .shown_as("under way", "idle"))
  bool serves(const ModelInfo& model) const override { return !model.joints.empty(); }
  std::string needs() const override { return "joints"; }
  std::unique_ptr<Device> make_device() const override {
    return std::make_unique<JointPoseTrajectory>();
  }
};

}  // namespace angen::robots

ANGEN_REGISTER_PLUGIN(angen::robots::JointPoseTrajectoryPlugin)

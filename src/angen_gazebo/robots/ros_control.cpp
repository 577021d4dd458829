// libgazebo_ros_control.so
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/lists.h"
#include "core/named.h"
#include "plugin/outputs.h"
#include "plugin/registration.h"
#include "plugin/view.h"
#include "plugin/wiring.h"
#include "robots/base.h"
#include "robots/joint_states.h"
#include "robots/names.h"

namespace angen::robots {

namespace {

constexpr double kResponse = 0.02;  // s, in which a position is reached but for a third
constexpr double kThere = 1e-6;     // rad or m
constexpr double kJump = 0.01;      // rad or m

enum class Interface { kPosition, kVelocity, kEffort };
constexpr const char* kInterfaces[] = {"position", "velocity", "effort"};

struct Transmission {
  std::string joint;
  Interface interface = Interface::kPosition;
};

// Transmissions of a URDF, which its conversion puts into the <plugin>.
std::vector<Transmission> read_transmissions(Params& params) {
  const std::vector<std::string> joints =
      params.texts("transmission/joint", "", "the URDF's <transmission>: its joint");
  const std::vector<std::string> words = params.texts(
      "transmission/hardwareInterface", "", "and its interface: …/PositionJointInterface, …");
  std::vector<Transmission> all;
  for (std::size_t i = 0; i < std::min(joints.size(), words.size()); ++i) {
    const auto is = [&](const char* word) { return words[i].find(word) != std::string::npos; };
    const Interface interface = is("Effort")     ? Interface::kEffort
                                : is("Velocity") ? Interface::kVelocity
                                                 : Interface::kPosition;
    all.push_back({joints[i], interface});
  }
  return all;
}

void read_others(Params& params) {
  params.text("controlPeriod", "", "s, between updates of ros_control's controllers; none: a tick");
  params.text("eStopTopic", "", "std_msgs/Bool: while true, ros_control's commands hold still");
  for (const char* path : {"robotParam", "robotSimType", "legacyModeNS"}) {
    params.text(path, "", "not used: the joints are the model's, as its transmissions say");
  }
}

}  // namespace

/// A joint that is commanded by a position, a velocity or an effort.
class JointCommand : public Device {
 public:
  explicit JointCommand(std::string joint) : name_(std::move(joint)) {}

  void configure(Params& params, Wiring& wiring) override {
    const std::vector<Transmission> all = read_transmissions(params);
    const auto own = std::find_if(all.begin(), all.end(),
                                  [this](const Transmission& each) { return each.joint == name_; });
    if (own != all.end()) interface_ = own->interface;
    read_others(params);
    joint_ = wiring.joint(name_);
    most_ = wiring.limits(joint_).effort;
  }

  Verdict command(const Command& command, const View& view) override {
    return Verdict::accept(
        [this, value = command.values[0], now = view.time()] { aim(value, now); });
  }

  void update(const View& view, Outputs& outputs) override {
    constexpr double kMax = std::numeric_limits<double>::infinity();
    if (interface_ == Interface::kEffort) {
      outputs.force(joint_, force());
      rests_ = target_.value_or(0.0) == 0.0;
      return;
    }
    double velocity = target_.value_or(0.0);
    if (interface_ == Interface::kPosition) {
      const double position = view.joint(joint_).position;
      // Only a service moves a joint so far within a tick.
      const bool is_set = !commanded_ && std::abs(last_position_ - position) > kJump;
      if (!target_ || is_set) target_ = position;
      last_position_ = position;
      const double left = *target_ - position;
      const double ahead = view.time() < slope_ends_ ? slope_ : 0.0;
      velocity = std::abs(left) < kThere && ahead == 0.0 ? 0.0 : ahead + left / kResponse;
    }
    // Sets only changed commands: before the first one another drive may move the joint.
    if (velocity != motor_velocity_) outputs.motor(joint_, velocity, kMax);
    motor_velocity_ = velocity;
    rests_ = interface_ == Interface::kVelocity || velocity == 0.0;
  }

  Nanoseconds idle_until(const View&) const override { return rests_ ? kForever : 0; }

  void report(const View& view, Reading& state) const override {
    state.set("joint", name_);
    state.set("interface", kInterfaces[static_cast<int>(interface_)]);
    state.set("command", target_.value_or(0.0));
    const JointView joint = view.joint(joint_);
    state.set("position", joint.position);
    state.set("effort", joint.effort + (interface_ == Interface::kEffort ? force() : 0.0));
  }

 private:
  double force() const { return std::clamp(target_.value_or(0.0), -most_, most_); }

  // Commands that follow each other closely are a motion: it continues until the next is due.
  void aim(double value, Nanoseconds now) {
    const double since = commanded_ ? to_seconds(now - *commanded_) : kResponse;
    const bool follows = since > 0.0 && since < kResponse;
    slope_ = follows ? (value - *target_) / since : 0.0;
    slope_ends_ = follows ? now + (now - *commanded_) : now;
    target_ = value;
    commanded_ = now;
  }

  std::string name_;
  Interface interface_ = Interface::kPosition;
  JointRef joint_;
  double most_ = 0.0;             // N m or N
  std::optional<double> target_;  // rad, rad/s or N m; m, m/s or N
  double last_position_ = 0.0;    // rad or m
  std::optional<Nanoseconds> commanded_;
  double slope_ = 0.0;  // rad/s or m/s
  Nanoseconds slope_ends_ = 0;
  std::optional<double> motor_velocity_;  // rad/s or m/s, set last
  bool rests_ = false;
};

class JointCommandPlugin : public Plugin {
 public:
  ANGEN_DESCRIBED_AS(Kind("joint_command",
                          "A joint that is commanded by position, velocity or effort.")
                         .value_units({"rad, m, rad/s, m/s, N m or N"})
                         .text("joint", "which it is")
                         .text("interface", "of its commands: position, velocity or effort")
                         .number("command", "", "the last one")
                         .number("position", "", "rad or m")
                         .shown(3)
                         .number("effort", "", "N m or N, along the axis"))
  std::vector<Mount> mounts(const ModelInfo& model, Params& params) const override {
    std::vector<Mount> mounts;
    for (const Transmission& each : read_transmissions(params)) {
      if (model.joint(each.joint) == nullptr) continue;
      const Mount mount{part_name(model.name, each.joint), each.joint};
      if (!index_in(mounts, mount.name)) mounts.push_back(mount);
    }
    return mounts;
  }
  std::string needs() const override { return "the <transmission>s of a URDF"; }
  std::unique_ptr<Device> make_device() const override {
    return std::make_unique<JointCommand>("joint");
  }
  std::unique_ptr<Device> make_device_on(const Mount& mount) const override {
    return std::make_unique<JointCommand>(mount.joint);
  }
};

/// The states of these joints.
class ControlledJoints : public JointStates {
 public:
  static Kind describe() {
    return joint_states_kind("controlled_joints", "States of the joints that take commands.");
  }
  void configure(Params& params, Wiring& wiring) override {
    std::vector<std::string> names;
    for (const Transmission& each : read_transmissions(params)) {
      const bool again = is_in(each.joint, names);
      if (wiring.has_joint(each.joint) && !again) names.push_back(each.joint);
    }
    read_others(params);
    set_up(std::move(names), wiring);
  }
};

class ControlledJointsPlugin : public BodySensorPlugin<ControlledJoints> {
 public:
  std::optional<std::string> link_of(Params& params) const override {
    return read_transmissions(params).empty() ? std::nullopt : std::make_optional("");
  }
};

}  // namespace angen::robots

ANGEN_REGISTER_PLUGIN(angen::robots::JointCommandPlugin)
ANGEN_REGISTER_PLUGIN(angen::robots::ControlledJointsPlugin)

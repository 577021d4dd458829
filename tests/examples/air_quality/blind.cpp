#include <plugin/register.h>

#include <algorithm>
#include <cmath>

namespace air_quality {

/// A roller blind: a motor moves its bar on the prismatic joint `blind`, 0 up, the lower limit
/// down.
class Blind : public angen::Device {
 public:
  void configure(angen::Params& params, angen::Wiring& wiring) override {
    speed_ = params.number("speed", 0.15, "m/s", "of the bar", angen::kPositive);
    force_ = params.number("force_max", 80.0, "N", "of the motor", angen::kPositive);
    joint_ = wiring.joint("blind");
    lowest_ = wiring.limits(joint_).lower;
    if (!(lowest_ < 0.0) || !std::isfinite(lowest_)) {
      throw params.error("", "the joint blind has no lower limit below 0");
    }
  }

  angen::Verdict command(const angen::Command& command, const angen::View&) override {
    double share = command.number / 100.0;  // of Set
    if (command.verb == "Up") share = 0.0;
    if (command.verb == "Down") share = 1.0;
    return angen::Verdict::accept([this, share] { target_ = share; });
  }

  void update(const angen::View& view, angen::Outputs& outputs) override {
    position_ = view.joint(joint_).position / lowest_;
    const double way = (target_ - position_) * lowest_;  // m
    const double seconds = angen::to_seconds(view.step());
    const bool there = std::abs(way) < kThere;
    if (there && standing_) return;
    const double velocity = there ? 0.0 : std::clamp(way / seconds, -speed_, speed_);
    outputs.motor(joint_, velocity, force_);
    if (there != standing_) outputs.event(there ? "stopped" : "moving", "");
    standing_ = there;
  }

  angen::Nanoseconds idle_until(const angen::View&) const override {
    return standing_ ? angen::kForever : 0;
  }

  void report(const angen::View&, angen::Reading& state) const override {
    state.set("moving", !standing_);
    state.set("position", std::round(1000.0 * position_) / 10.0);
    state.set("target", 100.0 * target_);
  }

 private:
  static constexpr double kThere = 0.001;  // m

  angen::JointRef joint_;
  double speed_ = 0.0;
  double force_ = 0.0;
  double lowest_ = 0.0;    // m
  double position_ = 0.0;  // 0 up, 1 down
  double target_ = 0.0;
  bool standing_ = false;
};

/// Every model with a prismatic joint `blind` has one.
class BlindPlugin : public angen::Plugin {
 public:
  const angen::Kind& kind() const override {
    static const angen::Kind kind =
        angen::Kind("blind", "A roller blind.")
            .example("set blind blind0 down")
            .verb("Up", "all the way")
            .verb("Down", "all the way")
            .verb("Set", "percent", "%", {0.0, 100.0}, "share of the window that it covers")
            .flag("moving", "whether it moves")
            .shown_as("moving", "still")
            .number("position", "%", "0 up, 100 down")
            .shown()
            .number("target", "%", "commanded position");
    return kind;
  }
  bool serves(const angen::ModelInfo& model) const override {
    const angen::ModelInfo::Joint* joint = model.joint("blind");
    return joint != nullptr && joint->type == "prismatic";
  }
  std::unique_ptr<angen::Device> make_device() const override { return std::make_unique<Blind>(); }
};

ANGEN_REGISTER_PLUGIN(BlindPlugin)

}  // namespace air_quality

#include <plugin/register.h>

namespace {

/// Turns a plate at a given speed.
class Turntable : public angen::Device {
 public:
  void configure(angen::Params& params, angen::Wiring& wiring) override {
    speed_ = params.number("speed", 3.5, "rad/s", "while it runs");
    torque_ = params.number("torque", 2.0, "N m", "its motor's greatest", angen::kPositive);
    spindle_ = wiring.joint("spindle");
  }

  angen::Verdict command(const angen::Command& command, const angen::View&) override {
    double target = command.number;  // of Turn
    if (command.verb == "Start") target = speed_;
    if (command.verb == "Stop") target = 0.0;
    return angen::Verdict::accept([this, target] { target_ = target; });
  }

  void update(const angen::View&, angen::Outputs& outputs) override {
    if (target_ == current_) return;
    outputs.motor(spindle_, target_, torque_);
    outputs.event(target_ == 0.0 ? "stopped" : "started", "");
    current_ = target_;
  }

  void report(const angen::View&, angen::Reading& state) const override {
    state.set("running", target_ != 0.0);
    state.set("target", target_);
  }

 private:
  double speed_ = 0.0;
  double torque_ = 0.0;
  double target_ = 0.0;
  double current_ = 0.0;
  angen::JointRef spindle_;
};

/// Every model with a revolute joint named `spindle` has one.
class TurntablePlugin : public angen::Plugin {
 public:
  const angen::Kind& kind() const override {
    static const angen::Kind kind =
        angen::Kind("turntable", "A plate that turns.")
            .verb("Start", "turns at its speed")
            .verb("Stop", "stands still")
            .verb("Turn", "radians per second", "rad/s", {}, "turns at this speed")
            .flag("running", "whether it turns")
            .shown_as("turning", "still")
            .number("target", "rad/s", "its speed");
    return kind;
  }
  bool serves(const angen::ModelInfo& model) const override {
    const angen::ModelInfo::Joint* spindle = model.joint("spindle");
    return spindle != nullptr && spindle->type == "revolute";
  }
  std::unique_ptr<angen::Device> make_device() const override {
    return std::make_unique<Turntable>();
  }
};

ANGEN_REGISTER_PLUGIN(TurntablePlugin)

}  // namespace

#include <plugin/register.h>

namespace {

/// Turns a plate at a given speed: `Start`, `Stop`, or the speed in rad/s as a value.
class Turntable : public angen::Device {
 public:
  void configure(angen::Params& params, angen::Wiring& wiring) override {
    speed_ = params.number("speed", 3.5, "rad/s", "while it runs");
    torque_ = params.number("torque", 2.0, "N m", "its motor's greatest", angen::kPositive);
    spindle_ = wiring.joint("spindle");
  }

  angen::Verdict command(const angen::Command& command, const angen::View&) override {
    if (!command.values.empty()) {
      target_ = command.values[0];
    } else if (command.text == "Start") {
      target_ = speed_;
    } else if (command.text == "Stop") {
      target_ = 0.0;
    } else {
      return angen::Verdict::reject("a turntable takes Start, Stop or a speed in rad/s");
    }
    return angen::Verdict::accept();
  }

  void update(const angen::View&, angen::Outputs& outputs) override {
    if (target_ == told_) return;
    outputs.motor(spindle_, target_, torque_);
    outputs.event(target_ == 0.0 ? "stopped" : "started", "");
    told_ = target_;
  }

  void report(const angen::View&, angen::Reading& state) const override {
    state.set("running", target_ != 0.0);
    state.set("target", target_);
  }

 private:
  double speed_ = 0.0;
  double torque_ = 0.0;
  double target_ = 0.0;
  double told_ = 0.0;
  angen::JointRef spindle_;
};

/// Every model with a revolute joint named `spindle` has one.
class TurntablePlugin : public angen::Plugin {
 public:
  std::string kind() const override { return "turntable"; }
  std::string doc() const override {
    return "A plate that turns: Start, Stop, or a speed in rad/s.";
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

// librobot_battery.so
#include <algorithm>

#include "devices/refresh.h"
#include "plugin/outputs.h"
#include "plugin/registration.h"
#include "plugin/view.h"
#include "plugin/wiring.h"

namespace angen::devices {

/// A robot's battery: it supplies the robot's electronics, and the work of all motors in
/// its model reports `work`.
class Battery : public Device {
 public:
  void configure(Params& params, Wiring& wiring) override {
    voltage_ = params.number("voltage", 14.8, "V", "taken as constant", kPositive);
    capacity_ = params.number("capacity", 2.2, "A h", "when full", kPositive);
    idle_power_ = params.number("idle_power", 10.0, "W", "of the electronics", kNotNegative);
    efficiency_ =
        params.number("efficiency", 0.6, "", "work of the wheels over electric work", {1e-3, 1.0});
    const double level = params.number("level", 100.0, "%", "charge at the start", {0.0, 100.0});
    energy_ = full() * level / 100.0;
    model_ = wiring.model();
  }

  Verdict command(const Command& command, const View&) override {
    return Verdict::accept([this, energy = full() * command.number / 100.0] { energy_ = energy; });
  }

  void update(const View& view, Outputs& outputs) override {
    if (!due_.due(view.time(), view.step())) return;
    const double work = work_done(view);
    if (counted_at_ >= 0 && energy_ > 0.0) {
      const double seconds = to_seconds(view.time() - counted_at_);
      const double used = idle_power_ * seconds + (work - work_) / efficiency_;
      power_ = seconds > 0.0 ? used / seconds : 0.0;
      energy_ = std::max(0.0, energy_ - used);
    }
    counted_at_ = view.time();
    work_ = work;
    const bool empty = energy_ <= 0.0;
    if (empty) power_ = 0.0;
    if (empty != empty_) outputs.event(empty ? "empty" : "charged", "");
    empty_ = empty;
  }

  // It supplies power also while all devices are idle.
  Nanoseconds idle_until(const View& view) const override { return due_.next(view.time()); }

  void save(SavedParams& params) const override {
    params.number("level", std::clamp(100.0 * energy_ / full(), 0.0, 100.0));
  }

  void report(const View&, Reading& state) const override {
    state.set("voltage", voltage_);
    state.set("capacity", capacity_);
    state.set("charge", energy_ / voltage_ / 3600.0);
    state.set("percentage", energy_ / full());
    state.set("drawn", power_);
    state.set("empty", empty_);
  }

 private:
  double full() const { return capacity_ * 3600.0 * voltage_; }  // J

  double work_done(const View& view) const {
    double sum = 0.0;
    for (const DeviceView& device : view.devices("work")) {
      if (device.model == model_) sum += device.state.get<double>("work");
    }
    return sum;
  }

  std::string model_;
  double voltage_ = 0.0;     // V
  double capacity_ = 0.0;    // A h
  double idle_power_ = 0.0;  // W
  double efficiency_ = 1.0;
  double energy_ = 0.0;  // J that are left
  double power_ = 0.0;   // W in the last second
  double work_ = 0.0;    // J, when it was counted last
  bool empty_ = false;
  Nanoseconds counted_at_ = -1;
  Refresh due_{1.0};
};

ANGEN_REGISTER_PART(Battery, model.name + "_battery",
                    Kind("battery", "A robot's battery.")
                        .group("")
                        .example("set battery turtlebot_battery 80")
                        .verb("Charge", "percent", "%", {0.0, 100.0},
                              "charges or discharges it to this")
                        .number("voltage", "V", "constant")
                        .number("capacity", "A h", "when full")
                        .number("charge", "A h", "that is left")
                        .number("percentage", "1", "of the charge that is left, 0 to 1")
                        .shown_as_percent()
                        .number("drawn", "W", "by the robot now")
                        .flag("empty", "whether nothing is left: the drive stops")
                        .alarm("EMPTY", ""))

}  // namespace angen::devices

#include <algorithm>

#include "plugin/register.h"

namespace angen::sensors {

/// A metering plug: the power of the device that it feeds, and the energy since its start.
class SmartPlug : public Sensor {
 public:
  Nanoseconds sample_period() const override { return kSecond / 50; }

  void configure(Params& params, Wiring&) override {
    load_ = params.text("load", "", "the device that it feeds, as lamp/kitchen0");
    params.noise("power", "W", "of a power");
  }

  void read(const View& view, Hits, Rng&, Reading& reading) override {
    if (sampled_at_ < 0 || view.time() < sampled_at_) {  // the first, or the clock was set back
      sampled_at_ = view.time();
      energy_ = 0.0;
    }
    bool connected = false;
    double power = 0.0;
    Nanoseconds changed = view.time();
    for (const DeviceView& device : view.devices("power")) {
      if (std::string(device.kind) + "/" + std::string(device.name) != load_) continue;
      connected = true;
      power = device.state.get<double>("power");
      changed = device.state.stamp;
    }
    count(power, changed, view.time());
    note_change(power, reading);
    power_ = power;
    reading.set("load", load_);
    reading.set("connected", connected);
    reading.set("power", power_);
    reading.set("energy", energy_);
  }

  bool steady() const override { return !(power_ > 0.0); }  // otherwise its energy grows

 private:
  // A change between two samples counts from the time of its state.
  void count(double power, Nanoseconds changed, Nanoseconds now) {
    const double before = power_;
    const Nanoseconds turn = power == before ? now : std::clamp(changed, sampled_at_, now);
    energy_ += before * to_seconds(turn - sampled_at_) + power * to_seconds(now - turn);
    sampled_at_ = now;
  }

  void note_change(double power, Reading& reading) const {
    if ((power > 0.0) == (power_ > 0.0)) return;
    reading.event = power > 0.0 ? "on" : "off";
    reading.urgent = true;
  }

  std::string load_;
  double power_ = 0.0;   // W, at the last sample
  double energy_ = 0.0;  // J
  Nanoseconds sampled_at_ = -1;
};

ANGEN_REGISTER_SENSOR(
    SmartPlug, Kind("plug", "The power and energy of the device that it feeds.")
                   .publishes_at(1.0)
                   .model("smart_plug")
                   .example("spawn plug p1 --pose \"0.1 1 0.3 0 0 0\" --set load=lamp/kitchen0")
                   .text("load", "the device that it feeds")
                   .shown()
                   .flag("connected", "whether there is such a device")
                   .shown_as("", "(no such load)")
                   .number("power", "W", "that the load takes")
                   .shown(1)
                   .number("energy", "J", "since the start")
                   .shown())

}  // namespace angen::sensors

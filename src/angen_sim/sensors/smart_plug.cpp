#include <algorithm>

#include "plugin/register.h"

namespace angen::sensors {

/// A metering plug: the power of the device that it feeds, and the energy since its start.
class SmartPlug : public Sensor {
 public:
  double default_rate() const override { return 1.0; }
  Nanoseconds sample_period() const override { return kSecond / 50; }

  void configure(Params& params, Wiring&) override {
    load_ = params.text("load", "", "the device that it feeds, as lamp/kitchen0");
    noise_stddev_ = params.number("noise_stddev", 0.0, "W", "of a power", kNotNegative);
  }

  void read(const View& view, Hits, Rng& rng, Reading& reading) override {
    if (looked_at_ < 0 || view.time() < looked_at_) {  // the first look, or the clock was set back
      looked_at_ = view.time();
      energy_ = 0.0;
    }
    bool found = false;
    double power = 0.0;
    Nanoseconds changed = view.time();
    for (const DeviceView& device : view.devices("power")) {
      if (std::string(device.kind) + "/" + std::string(device.name) != load_) continue;
      found = true;
      power = device.state.get<double>("power");
      changed = device.state.stamp;
    }
    count(power, changed, view.time());
    tell_change(power, reading);
    power_ = power;
    reading.set("load", load_);
    reading.set("connected", found);
    reading.set("power", power + (noise_stddev_ > 0.0 ? noise_stddev_ * rng.gaussian() : 0.0));
    reading.set("energy", energy_);
  }

  Rest rest() const override {
    if (power_ > 0.0) return Rest::kBusy;  // its energy grows
    return noise_stddev_ > 0.0 ? Rest::kNoise : Rest::kSame;
  }
  bool quiet(Rng) const override { return true; }  // events are told of the power without noise

 private:
  // A change between two looks counts from the moment that its state tells.
  void count(double power, Nanoseconds changed, Nanoseconds now) {
    const Nanoseconds turn = power == power_ ? now : std::clamp(changed, looked_at_, now);
    energy_ += power_ * to_seconds(turn - looked_at_) + power * to_seconds(now - turn);
    looked_at_ = now;
  }

  void tell_change(double power, Reading& reading) const {
    if ((power > 0.0) == (power_ > 0.0)) return;
    reading.event = power > 0.0 ? "on" : "off";
    reading.urgent = true;
  }

  std::string load_;
  double noise_stddev_ = 0.0;  // W
  double power_ = 0.0;         // W, at the last look
  double energy_ = 0.0;        // J
  Nanoseconds looked_at_ = -1;
};

ANGEN_REGISTER_SENSOR(SmartPlug, "plug", "The power and energy of the device that it feeds.")

}  // namespace angen::sensors

#include <algorithm>

#include "plugin/register.h"
#include "sensors/one_draw.h"

namespace angen::sensors {

namespace {

/// What it measures; as an echo, what is read while that stays.
struct Metered : OneDraw {
  std::string load;
  bool connected = false;
  double power = 0.0;         // W
  double energy = 0.0;        // J
  double noise_stddev = 0.0;  // W

  void tell(Rng rng, Reading& reading) const override {
    reading.set("load", load);
    reading.set("connected", connected);
    reading.set("power", power + (noise_stddev > 0.0 ? noise_stddev * rng.gaussian() : 0.0));
    reading.set("energy", energy);
  }
};

}  // namespace

/// A metering plug: the power of the device that it feeds, and the energy since its start.
class SmartPlug : public Sensor {
 public:
  double default_rate() const override { return 1.0; }
  Nanoseconds sample_period() const override { return kSecond / 50; }

  void configure(Params& params, Wiring&) override {
    metered_.load = params.text("load", "", "the device that it feeds, as lamp/kitchen0");
    metered_.noise_stddev = params.number("noise_stddev", 0.0, "W", "of a power", kNotNegative);
  }

  void read(const View& view, Hits, Rng& rng, Reading& reading) override {
    if (looked_at_ < 0 || view.time() < looked_at_) {  // the first look, or the clock was set back
      looked_at_ = view.time();
      metered_.energy = 0.0;
    }
    metered_.connected = false;
    double power = 0.0;
    Nanoseconds changed = view.time();
    for (const DeviceView& device : view.devices("power")) {
      if (std::string(device.kind) + "/" + std::string(device.name) != metered_.load) continue;
      metered_.connected = true;
      power = device.state.get<double>("power");
      changed = device.state.stamp;
    }
    count(power, changed, view.time());
    tell_change(power, reading);
    metered_.power = power;
    metered_.tell(rng, reading);
  }

  Rest rest() const override {
    if (metered_.power > 0.0) return Rest::kBusy;  // its energy grows
    return metered_.noise_stddev > 0.0 ? Rest::kNoise : Rest::kSame;
  }
  double quiet_chance() const override { return 1.0; }  // events tell the power without noise
  std::shared_ptr<const Echo> echo() const override { return std::make_shared<Metered>(metered_); }

 private:
  // A change between two looks counts from the moment that its state tells.
  void count(double power, Nanoseconds changed, Nanoseconds now) {
    const double before = metered_.power;
    const Nanoseconds turn = power == before ? now : std::clamp(changed, looked_at_, now);
    metered_.energy += before * to_seconds(turn - looked_at_) + power * to_seconds(now - turn);
    looked_at_ = now;
  }

  void tell_change(double power, Reading& reading) const {
    if ((power > 0.0) == (metered_.power > 0.0)) return;
    reading.event = power > 0.0 ? "on" : "off";
    reading.urgent = true;
  }

  Metered metered_;  // at the last look
  Nanoseconds looked_at_ = -1;
};

ANGEN_REGISTER_SENSOR(SmartPlug, "plug", "The power and energy of the device that it feeds.")

}  // namespace angen::sensors

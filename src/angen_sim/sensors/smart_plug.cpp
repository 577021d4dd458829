// libsmart_plug.so
#include <algorithm>

#include "plugin/registration.h"
#include "plugin/view.h"

namespace angen::sensors {

namespace {

/// A plug's readings while its load does not change: a constant power, and energy that grows.
struct Metering : LazyReading {
  std::string load;  // KIND/NAME
  bool connected = false;
  double power = 0.0;     // W
  double energy = 0.0;    // J, up to `since`
  Nanoseconds since = 0;  // the power's last change

  double energy_at(Nanoseconds time) const { return energy + power * to_seconds(time - since); }

  void read(Nanoseconds time, const Draws&, Reading& reading) const override {
    reading.set("load", load);
    reading.set("connected", connected);
    reading.set("power", power);
    reading.set("energy", energy_at(time));
  }
};

}  // namespace

/// A metering plug: the power of the device that it feeds, and the energy since its start.
class SmartPlug : public Sensor {
 public:
  void configure(Params& params, Wiring&) override {
    sample_period_ = kSecond / 50;
    metering_.load = params.text("load", "", "the device that it feeds, as lamp/kitchen0");
    const std::size_t bar = metering_.load.find('/');
    kind_ = metering_.load.substr(0, bar);
    if (bar != std::string::npos) name_ = metering_.load.substr(bar + 1);
    standby_ = params.number("standby", 0.0, "W", "up to which the load is off", kNotNegative);
    params.noise("power", "W", "of a power");
  }

  void read(const View& view, Hits, Rng&, Reading& reading) override {
    const Nanoseconds now = view.time();
    if (sampled_at_ < 0 || now < sampled_at_) {  // the first, or the clock was set back
      sampled_at_ = metering_.since = now;
      metering_.energy = 0.0;
    }
    metering_.connected = false;
    double power = 0.0;
    Nanoseconds changed = now;
    if (const auto load = view.device("power", kind_, name_)) {
      metering_.connected = true;
      power = load->state.get<double>("power");
      changed = load->state.stamp;
    }
    // A change between two samples counts from the time of its state.
    if (power != metering_.power) set_power(power, std::clamp(changed, sampled_at_, now), reading);
    sampled_at_ = now;
    metering_.read(now, {}, reading);
  }

  Nanoseconds idle_until(const Ahead&) const override { return kForever; }
  std::shared_ptr<const LazyReading> lazy_reading() const override {
    if (metering_.power == 0.0) return nullptr;
    return std::make_shared<Metering>(metering_);
  }
  void skip(Nanoseconds time, const Draws&) override { sampled_at_ = time; }

 private:
  void set_power(double power, Nanoseconds at, Reading& reading) {
    metering_.energy = metering_.energy_at(at);
    metering_.since = at;
    if ((power > standby_) != (metering_.power > standby_)) {
      reading.announce(power > standby_ ? "on" : "off");
    }
    metering_.power = power;
  }

  std::string kind_;
  std::string name_;
  double standby_ = 0.0;
  Metering metering_;
  Nanoseconds sampled_at_ = -1;
};

ANGEN_REGISTER_SENSOR(
    SmartPlug, Kind("plug", "The power and energy of the device that it feeds.")
                   .rate(1.0)
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

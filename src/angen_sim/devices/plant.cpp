// libplant.so
#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "devices/refresh.h"
#include "plugin/outputs.h"
#include "plugin/registration.h"
#include "plugin/rooms.h"
#include "plugin/view.h"

namespace angen::devices {

namespace {

constexpr double kDay = 86400.0;  // s
constexpr double kKelvin = 273.15;
constexpr double kPsychrometer = 0.66;         // hPa/K, at sea level
constexpr double kLatentHeat = 2.45e6;         // J/kg, of water at 20 degrees
constexpr double kDryingPower = 0.35 / 1.333;  // mm/(day hPa) in still air: Penman's 0.35 a mm Hg
constexpr double kWhiteLight = 100.0;          // lm/W, of daylight and of white lamps

// hPa over water, Magnus with Sonntag's constants, as in the climate.
double vapor_pressure(double temperature) {
  return 6.112 * std::exp(17.62 * temperature / (243.12 + temperature));
}

// Water that a wet surface loses, mm (kg/m^2) a day: H. L. Penman, Natural evaporation from open
// water, bare soil and grass, Proc. R. Soc. A 193 (1948), with no wind. `light` in lx.
double penman(double temperature, double humidity, double light) {
  const double saturated = vapor_pressure(temperature);
  const double slope = saturated * 17.62 * 243.12 / std::pow(243.12 + temperature, 2);  // hPa/K
  const double radiation = light / kWhiteLight * kDay / kLatentHeat;                    // mm a day
  const double dry = kDryingPower * saturated * (1.0 - humidity / 100.0);
  return (slope * radiation + kPsychrometer * dry) / (slope + kPsychrometer);
}

}  // namespace

/// A plant in a pot: its soil dries as fast as air and light let it, and slower once it is half
/// dry; it is watered by command.
class Plant : public Device {
 public:
  void configure(Params& params, Wiring&) override {
    soil_ = params.number("soil", 8.0, "l", "volume of the soil", kPositive);
    area_ = params.number("area", 0.06, "m^2",
                          "that gives off water: of leaves and soil, from above", kPositive);
    full_ = params.number("field_capacity", 30.0, "%", "water that the soil holds, of its volume",
                          {0.0, 100.0});
    dead_ = params.number("wilting_point", 12.0, "%", "water that no root gets out of it",
                          {0.0, full_});
    if (!(full_ > dead_)) {
      throw params.error("wilting_point", "wilting_point must be below field_capacity");
    }
    ease_ =
        params.number("depletion", 0.5, "",
                      "share of the water between these two that roots get easily", {0.0, 0.99});
    moisture_ = params.number("moisture", full_, "%", "at the start", {dead_, full_});
    leaf_height_ = params.number("leaf_height", 0.7, "m", "where light falls on it", kNotNegative);
  }

  Verdict command(const Command& command, const View&) override {
    return Verdict::accept([this, volume = command.number] { watered_ += volume; });
  }

  void update(const View& view, Outputs& outputs) override {
    const bool due = due_.due(view.time(), view.step());
    if (!due && watered_ == 0.0) return;
    dry(view);
    if (watered_ > 0.0) water(outputs);
    note(outputs);
  }

  Nanoseconds idle_until(const View& view) const override { return due_.next(view.time()); }

  void save(SavedParams& params) const override { params.number("moisture", moisture_); }

  void report(const View&, Reading& state) const override {
    state.set("moisture", moisture_);
    state.set("evaporation", flow_ * 3600.0);
    state.set("drained", drained_);
    state.set("dry", dry_);
  }

 private:
  Pose leaves(const View& view) const {
    return {view.pose() * Vec3(0.0, 0.0, leaf_height_),
            Quat::FromTwoVectors(Vec3::UnitX(), Vec3::UnitZ())};
  }
  double per_ml() const { return 100.0 / (1000.0 * soil_); }  // % of moisture

  // R. G. Allen et al., Crop evapotranspiration, FAO Irrigation and Drainage Paper 56 (1998): the
  // share Ks of the loss of a wet surface. Exact while air and light stay.
  void dry(const View& view) {
    const Nanoseconds before = dried_at_ < 0 ? view.time() : dried_at_;
    dried_at_ = view.time();
    if (before == dried_at_) return;  // at the start lamps have not been switched yet
    const Pose up = leaves(view);
    const AirHere here = air_at(view, up.position);
    const double temperature = air_temperature(view, up.position) - kKelvin;
    const double humidity = std::isnan(here.humidity) ? 50.0 : here.humidity;
    if (view.time() >= lit_at_) {
      light_ = view.illuminance(probe_, up).illuminance;
      lit_at_ = lit_.next(view.time());
    }
    const double wet = 1000.0 * area_ * penman(temperature, humidity, light_) / kDay;  // ml/s
    const double seconds = to_seconds(dried_at_ - before);
    const double knee = full_ - ease_ * (full_ - dead_);
    const double rate = wet * per_ml();  // %/s while it takes water with ease
    const double easy = rate > 0.0 ? std::clamp((moisture_ - knee) / rate, 0.0, seconds) : seconds;
    moisture_ -= easy * rate;
    if (easy < seconds) {
      moisture_ = dead_ + (moisture_ - dead_) * std::exp(-(seconds - easy) * rate / (knee - dead_));
    }
    flow_ = wet * std::clamp((moisture_ - dead_) / (knee - dead_), 0.0, 1.0);
  }

  void water(Outputs& outputs) {
    const double gets = std::min(watered_, (full_ - moisture_) / per_ml());
    moisture_ += gets * per_ml();
    drained_ += watered_ - gets;
    std::string detail = text_of(watered_, " ml");
    if (gets < watered_) detail += text_of(", ", std::round(watered_ - gets), " ml run through");
    outputs.event("watered", detail);
    watered_ = 0.0;
  }

  void note(Outputs& outputs) {
    const bool dry = moisture_ < full_ - ease_ * (full_ - dead_);
    if (dry && !dry_) outputs.event("dry", "");
    dry_ = dry;
  }

  double soil_ = 0.0;         // l
  double area_ = 0.0;         // m^2
  double full_ = 0.0;         // %
  double dead_ = 0.0;         // %
  double ease_ = 0.0;         // 1
  double leaf_height_ = 0.0;  // m
  double moisture_ = 0.0;     // %
  double watered_ = 0.0;      // ml, not yet in the soil
  double drained_ = 0.0;      // ml, since the start
  double flow_ = 0.0;         // ml/s
  bool dry_ = false;
  light::Probe probe_;
  double light_ = 0.0;      // lx
  Refresh lit_{1.0 / 600};  // light costs more than all else
  Nanoseconds lit_at_ = 0;
  Nanoseconds dried_at_ = -1;
  Refresh due_{1.0 / 60.0};
};

ANGEN_REGISTER_DEVICE(Plant,
                      Kind("plant", "A plant in a pot, whose soil dries and is watered.")
                          .model("plant")
                          .example("set plant entrance_plant0 water 300")
                          .verb("Water", "milliliters", "ml", {0.0, 1e5}, "pours water on its soil")
                          .number("moisture", "%", "water in the soil, of its volume")
                          .shown(1)
                          .number("evaporation", "ml/h", "that leaves and soil give off")
                          .shown(1)
                          .number("drained", "ml", "that ran through since the start")
                          .flag("dry", "whether roots get less water than they could use")
                          .shown_as("dry", ""))

}  // namespace angen::devices

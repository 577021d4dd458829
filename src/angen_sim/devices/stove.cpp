// libstove.so
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "devices/part_names.h"
#include "devices/refresh.h"
#include "plugin/outputs.h"
#include "plugin/registration.h"
#include "plugin/rooms.h"
#include "plugin/view.h"
#include "plugin/wiring.h"

namespace angen::devices {

namespace {

constexpr double kRate = 1.0;        // Hz: plates take minutes
constexpr double kHot = 60.0;        // degrees Celsius: the residual heat lamp is lit above
constexpr double kHotAgain = 2.0;    // K that it has to cool below that
constexpr double kCelsius = 273.15;  // K
constexpr double kSameAir = 0.02;    // K: by less the course of a plate as PIRs see it stays
constexpr Nanoseconds kTimeout = kSecond / 10;  // a climate has published its state by then
constexpr Range kPlateRange{-60.0, 2000.0};

const char* const kPlateVerbs[] = {"FrontLeft", "FrontRight", "RearLeft", "RearRight"};
constexpr std::size_t kMaxPlates = std::size(kPlateVerbs);

}  // namespace

/// A stove: each plate is a heat capacity that its electric power warms and the room's air cools.
class Stove : public Device {
 public:
  void configure(Params& params, Wiring& wiring) override {
    const auto rows = params.rows("plate", 3, "W J/K W/K",
                                  "a plate's electric power at 100 %, heat capacity, and heat "
                                  "loss to the air; front left, front right, rear left, rear "
                                  "right; four plates unless given");
    for (const std::vector<double>& row : rows) {
      if (!(row[0] > 0.0 && row[1] > 0.0 && row[2] > 0.0)) {
        throw params.error("plate", "a <plate> needs three numbers above 0: W, J/K and W/K");
      }
      plates_.push_back({row[0], row[1], row[2]});
    }
    if (rows.empty()) {
      const Plate large{1500.0, 960.0, 3.0};
      const Plate small{1000.0, 620.0, 2.0};
      plates_ = {large, small, small, large};
    }
    if (plates_.size() > kMaxPlates) throw params.error("plate", "a stove has four plates at most");
    const auto starts = params.rows("start", 2, "% degC",
                                    "level and temperature of each plate at the start; off and as "
                                    "warm as the air unless given");
    if (!starts.empty() && starts.size() != plates_.size()) {
      throw params.error("start", "give one <start> for each plate, or none");
    }
    for (std::size_t i = 0; i < starts.size(); ++i) {
      const double level = starts[i][0];
      const double temperature = starts[i][1];
      if (!(level >= 0.0 && level <= 100.0) || !kPlateRange.contains(temperature)) {
        throw params.error("start", "a <start> is outside 0 to 100 % or -60 to 2000 degrees");
      }
      plates_[i].level = plates_[i].heated_at = level;
      plates_[i].temperature = temperature;
      started_ = true;
    }
    const auto visuals = params.texts("plate_visual", "",
                                      "the visual of each plate, which PIRs see warm; in the "
                                      "order of the plates");
    if (visuals.size() > plates_.size()) {
      throw params.error("plate_visual", "there are more <plate_visual> than plates");
    }
    for (std::size_t i = 0; i < visuals.size(); ++i) {
      plates_[i].surfaces = wiring.surfaces(visuals[i]);
    }
  }

  Verdict command(const Command& command, const View&) override {
    const auto* const verb =
        std::find(std::begin(kPlateVerbs), std::end(kPlateVerbs), command.verb);
    if (verb == std::end(kPlateVerbs)) {
      return Verdict::accept([this, level = command.verb == "Set" ? command.number : 0.0] {
        for (Plate& plate : plates_) plate.level = level;
      });
    }
    const auto index = static_cast<std::size_t>(std::distance(std::begin(kPlateVerbs), verb));
    if (index >= plates_.size()) {
      return Verdict::reject("this stove has " + std::to_string(plates_.size()) +
                             " plates only, and no " + command.verb);
    }
    return Verdict::accept([this, index, level = command.number] { plates_[index].level = level; });
  }

  void update(const View& view, Outputs& outputs) override {
    const bool set = std::any_of(plates_.begin(), plates_.end(),
                                 [](const Plate& p) { return p.level != p.heated_at; });
    const bool due = due_.due(view.time(), view.step());
    if (started_ && !due && !set) return;
    air_ = air_at(view, view.pose().position).temperature;
    const bool known = !std::isnan(air_);
    if (!known) air_ = view.ambient_temperature() - kCelsius;
    if (!started_) {
      for (Plate& plate : plates_) plate.temperature = air_;
      if (!known && view.time() < kTimeout) return;
      started_ = true;
    }
    const bool first = stepped_at_ < 0;
    const Nanoseconds before = stepped_at_ < 0 ? view.time() : stepped_at_;
    stepped_at_ = view.time();
    const bool was_on = on_;
    const bool was_hot = hot_;
    on_ = false;
    const bool other_air = first || std::abs(air_ - seen_air_) > kSameAir;
    if (other_air) seen_air_ = air_;
    for (Plate& plate : plates_) {
      plate.step(to_seconds(stepped_at_ - before), air_);
      if (other_air || plate.heated_at != plate.level) plate.warm(air_, outputs);
      plate.heated_at = plate.level;
      on_ = on_ || plate.level > 0.0;
    }
    hot_ = hottest() > (was_hot ? kHot - kHotAgain : kHot);
    if (std::exchange(updated_, true)) publish_events(was_on, was_hot, set, outputs);
  }

  Nanoseconds idle_until(const View& view) const override {
    return started_ ? due_.next(view.time()) : 0;
  }

  void save(SavedParams& params) const override {
    if (!started_) return;
    for (const Plate& plate : plates_) params.row("start", {plate.level, plate.temperature});
  }

  void report(const View&, Reading& state) const override {
    std::vector<double> levels;
    std::vector<double> temperatures;
    double power = 0.0;
    double heat = 0.0;
    for (const Plate& plate : plates_) {
      levels.push_back(plate.level);
      temperatures.push_back(plate.temperature);
      power += plate.power * plate.level / 100.0;
      heat += plate.loss * (plate.temperature - air_);
    }
    state.set("on", on_);
    state.set("hot", hot_);
    state.set("hottest", hottest());
    state.set("power", power);
    state.set("heat", heat);
    state.set("levels", std::move(levels));
    state.set("plate_temperatures", std::move(temperatures));
  }

 private:
  struct Plate {
    double power = 0.0;        // W at 100 %
    double capacity = 0.0;     // J/K
    double loss = 0.0;         // W/K
    double temperature = 0.0;  // degrees Celsius
    double level = 0.0;        // percent
    double heated_at = 0.0;    // percent, since the last step
    std::vector<SurfaceRef> surfaces = {};

    double limit(double percent) const { return power * percent / 100.0 / loss; }

    // C dT/dt = P - G (T - air), solved for a constant power and air.
    void step(double seconds, double air) {
      const double left = std::exp(-seconds * loss / capacity);
      const double hottest = air + limit(heated_at);
      temperature = hottest + (temperature - hottest) * left;
    }

    void warm(double air, Outputs& outputs) const {
      const double hottest = air + limit(level);
      for (const SurfaceRef surface : surfaces) {
        outputs.temperature(surface, temperature + kCelsius, hottest + kCelsius, capacity / loss);
      }
    }
  };

  void publish_events(bool was_on, bool was_hot, bool set, Outputs& outputs) const {
    if (on_ != was_on) {
      outputs.event(on_ ? "on" : "off", "");
    } else if (set) {
      outputs.event("set", "");
    }
    if (hot_ != was_hot) outputs.event(hot_ ? "hot" : "cool", "");
  }

  double hottest() const {
    double most = plates_.front().temperature;
    for (const Plate& plate : plates_) most = std::max(most, plate.temperature);
    return most;
  }

  std::vector<Plate> plates_;
  double air_ = 0.0;       // degrees Celsius
  double seen_air_ = 0.0;  // the same, when PIRs were last told
  bool started_ = false;
  bool updated_ = false;
  bool on_ = false;
  bool hot_ = false;
  Nanoseconds stepped_at_ = -1;
  Refresh due_{kRate};
};

// Its verbs are those of its plates, and of all.
Kind stove_kind() {
  Kind made("stove", "An electric stove whose plates warm.");
  made.model("stove").example("set stove kitchen0 frontleft 60");
  for (const char* verb : kPlateVerbs) {
    made.verb(verb, "percent", "%", {0.0, 100.0}, "power of this plate, of its full power");
  }
  made.verb("Set", "percent", "%", {0.0, 100.0}, "power of all plates")
      .verb("Off", "all plates off")
      .flag("on", "whether a plate heats")
      .shown_as("on", "off")
      .flag("hot", "whether a plate is above 60 °C")
      .alarm("HOT", "")
      .number("hottest", "°C", "of its hottest plate")
      .shown()
      .number("power", "W", "electric power")
      .shown()
      .number("heat", "W", "that its plates give to the air of the room")
      .numbers("levels", "%", "of each plate, of its full power")
      .numbers("plate_temperatures", "°C", "of each plate");
  return made;
}

ANGEN_REGISTER_PART(Stove, command_name(model, "stove"), stove_kind())

}  // namespace angen::devices

// libcup.so
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/text.h"
#include "devices/profile.h"
#include "devices/refresh.h"
#include "plugin/outputs.h"
#include "plugin/registration.h"
#include "plugin/rooms.h"
#include "plugin/view.h"
#include "plugin/wiring.h"

namespace angen::devices {

namespace {

constexpr double kDensity = 1e-3;     // kg/ml, of water
constexpr double kHeat = 4.186;       // J/(ml K), of water
constexpr double kMilliliters = 1e6;  // in a m^3
constexpr double kKelvin = 273.15;
constexpr double kStiffness = 400.0;       // 1/s^2 of the hand's grip, 20 rad/s and damped
constexpr double kDamping = 40.0;          // 1/s
constexpr double kNoDrop = 0.01;           // ml: less is no spill
constexpr double kFreeToTilt = 0.05;       // m over its support
constexpr double kSameTemperature = 0.01;  // K
constexpr Nanoseconds kPourEnds = kSecond / 2;

// rad, between the cup's axis and the vertical.
double tilt_of(const Pose& pose) {
  return std::acos(std::clamp((pose.rotation * Vec3::UnitZ()).z(), -1.0, 1.0));
}

std::string volume_text(double volume) { return text_of(std::round(10.0 * volume) / 10.0, " ml"); }

// m^3 that an upright cylinder of this radius and height (m) still holds when it is tilted (rad).
// Up to where the surface meets the bottom it is the cylinder below the mean height; beyond, a hoof
// (J. W. Harris and H. Stocker, Handbook of Mathematics and Computational Science, 1998).
double held_volume(double radius, double height, double tilt) {
  if (tilt >= M_PI / 2) return 0.0;
  const double slope = std::tan(tilt);
  if (2.0 * radius * slope <= height) {
    return M_PI * radius * radius * (height - radius * slope);
  }
  const double wet = height / slope;  // m of the bottom's diameter that is under the drink
  const double chord = std::sqrt(wet * (2.0 * radius - wet));
  const double angle = std::acos((radius - wet) / radius);
  return height / (3.0 * wet) *
         (chord * (3.0 * radius * radius - chord * chord) +
          3.0 * radius * radius * (wet - radius) * angle);
}

}  // namespace

/// A cup with a drink in it: it cools, adds its weight, and runs out over the lip. A
/// hand lifts and tilts it.
class Cup : public Device {
 public:
  void configure(Params& params, Wiring& wiring) override;
  Verdict command(const Command& command, const View& view) override;
  void update(const View& view, Outputs& outputs) override;
  void report(const View& view, Reading& state) const override;
  void save(SavedParams& params) const override;
  Nanoseconds idle_until(const View& view) const override;

 private:
  struct Grasp {
    Pose pose;  // where the hand took it
    double height = 0.0;
    double tilt = 0.0;
    bool releases = false;
  };

  double capacity() const;
  double heat_capacity() const;        // J/K, of cup and drink
  double air(const View& view) const;  // degrees Celsius, around it
  Verdict fill(double volume, const View& view);
  void cool(Nanoseconds now, double air);
  void spill(double tilt, Outputs& outputs);
  void carry(const View& view, const LinkView& body, Outputs& outputs);
  void weigh(const View& view, Outputs& outputs) const;

  LinkRef body_;
  double mass_ = 0.0;              // kg, empty
  double radius_ = 0.0;            // m, inside
  double height_ = 0.0;            // m, inside
  double floor_ = 0.0;             // m, from the link's origin up to the inside
  double center_ = 0.0;            // m, from the link's origin up to its center of mass
  double heat_loss_ = 0.0;         // W/K
  double cup_heat_ = 0.0;          // J/K
  double fill_temperature_ = 0.0;  // degrees Celsius
  double hand_force_ = 0.0;        // N

  double content_ = 0.0;  // ml
  double poured_ = 0.0;   // ml, since the start
  std::optional<double> temperature_;
  int unknown_air_ = 0;  // updates, until a climate has reported the air that it starts at
  bool pours_ = false;
  bool changed_ = false;  // its weight did, while it may have been asleep
  Nanoseconds cooled_at_ = -1;
  Nanoseconds spilled_at_ = -1;
  std::optional<Grasp> grasp_;
  Profile lift_{0.4, 2.0};  // m/s, m/s^2
  Profile turn_{1.5, 6.0};  // rad/s, rad/s^2
  Refresh due_{0.1};
};

void Cup::configure(Params& params, Wiring& wiring) {
  radius_ = params.number("radius", 0.037, "m", "of its inside", kPositive);
  height_ = params.number("height", 0.085, "m", "of its inside", kPositive);
  floor_ = params.number("floor", 0.008, "m", "thickness of its bottom", kNotNegative);
  center_ = params.number("center", 0.0465, "m", "of its own mass, above its foot", kNotNegative);
  heat_loss_ = params.number("heat_loss", 0.7, "W/K",
                             "to the air, by convection, radiation and vapor", kNotNegative);
  cup_heat_ = params.number("heat_capacity", 300.0, "J/K", "of the empty cup", kPositive);
  fill_temperature_ =
      params.number("fill_temperature", 85.0, "degC", "of a drink that is filled in", {0.0, 100.0});
  hand_force_ = params.number("hand_force", 30.0, "N", "greatest force of the hand", kPositive);
  content_ = params.number("content", 0.0, "ml", "at the start", {0.0, capacity()});
  const double start = params.number("temperature", fill_temperature_, "degC",
                                     "of cup and drink at the start; as fill_temperature where "
                                     "there is a drink, as the air where there is none",
                                     {-50.0, 100.0});
  if (content_ > 0.0 || params.has("temperature")) {
    temperature_ = start;
  } else {
    unknown_air_ = 2;
  }
  poured_ = params.number("poured", 0.0, "ml", "that have run out before the start", kNotNegative);
  body_ = wiring.link(params.text("link", "body", "the link that is the cup, origin at its foot"));
  mass_ = wiring.mass(body_);
}

double Cup::capacity() const { return kMilliliters * held_volume(radius_, height_, 0.0); }

double Cup::heat_capacity() const { return cup_heat_ + kHeat * content_; }

Verdict Cup::fill(double volume, const View& view) {
  if (content_ + volume > capacity()) {
    return Verdict::reject("it takes " + volume_text(capacity()) + " and has " +
                           volume_text(content_) + " in it");
  }
  return Verdict::accept([this, volume, now = view.time(), around = air(view)] {
    cool(now, around);
    temperature_ = (heat_capacity() * *temperature_ + kHeat * volume * fill_temperature_) /
                   (heat_capacity() + kHeat * volume);
    content_ += volume;
    unknown_air_ = 0;
    changed_ = true;
  });
}

Verdict Cup::command(const Command& command, const View& view) {
  if (command.verb == "Fill") return fill(command.number, view);
  if (command.verb == "Empty") {
    return Verdict::accept([this] {
      content_ = 0.0;
      changed_ = true;
    });
  }
  if (command.verb == "Lift") {
    return Verdict::accept([this, height = command.number, body = view.link(body_)] {
      if (!grasp_) {
        grasp_ = Grasp{body.pose};
        lift_.start(0.0);
        turn_.start(0.0);
      }
      grasp_->height = height;
      grasp_->releases = false;
    });
  }
  if (!grasp_) return Verdict::reject("no hand holds it; lift it first, as Lift 0.2");
  if (command.verb == "Tilt") {
    if (grasp_->height < kFreeToTilt) {
      return Verdict::reject("it is too low to be tilted; lift it by 0.05 m at least");
    }
    return Verdict::accept([this, tilt = command.number] { grasp_->tilt = tilt; });
  }
  return Verdict::accept([this] {  // Put
    grasp_->tilt = 0.0;
    grasp_->height = 0.0;
    grasp_->releases = true;
  });
}

void Cup::update(const View& view, Outputs& outputs) {
  const LinkView body = view.link(body_);
  if (unknown_air_ > 0) {
    --unknown_air_;
    temperature_.reset();
  }
  if (!temperature_ || due_.due(view.time(), view.step()) || changed_) {
    cool(view.time(), air(view));
  }
  const double poured = poured_;
  spill(tilt_of(body.pose), outputs);
  if (poured_ > poured) spilled_at_ = view.time();
  if (pours_ && view.time() - spilled_at_ >= kPourEnds) {
    pours_ = false;
    outputs.event("poured", volume_text(poured_) + " in all");
  }
  if (grasp_) {
    carry(view, body, outputs);
  } else if (body.awake || changed_) {
    weigh(view, outputs);
  }
  changed_ = false;
}

double Cup::air(const View& view) const {
  return air_temperature(view, view.link(body_).pose.position) - kKelvin;
}

// Newton's law, exactly, since it was computed last.
void Cup::cool(Nanoseconds now, double air) {
  if (!temperature_) temperature_ = air;
  if (cooled_at_ >= 0) {
    const double seconds = to_seconds(now - cooled_at_);
    temperature_ = air + (*temperature_ - air) * std::exp(-seconds * heat_loss_ / heat_capacity());
  }
  cooled_at_ = now;
}

void Cup::spill(double tilt, Outputs& outputs) {
  const double over = content_ - kMilliliters * held_volume(radius_, height_, tilt);
  if (over < kNoDrop) return;
  if (!pours_) outputs.event("pours", "");
  pours_ = true;
  content_ -= over;
  poured_ += over;
  changed_ = true;
}

// The hand's grip is a damped spring to the target pose of the cup; it carries the
// weight of cup and drink.
void Cup::carry(const View& view, const LinkView& body, Outputs& outputs) {
  const double dt = to_seconds(view.step());
  Grasp& grasp = *grasp_;
  // It rises before it tilts, and is upright before it sinks.
  const bool high = lift_.position() >= std::min(grasp.height, kFreeToTilt);
  if (high || grasp.tilt == 0.0) turn_.advance(grasp.tilt, dt);
  if (!grasp.releases || turn_.at(0.0)) lift_.advance(grasp.height, dt);
  if (grasp.releases && lift_.at(0.0) && turn_.at(0.0)) {
    grasp_.reset();
    changed_ = true;
    return weigh(view, outputs);
  }
  const bool still = lift_.at(grasp.height) && turn_.at(grasp.tilt);
  if (still && !body.awake) return;  // a sleeping cup in a hand is held
  const Pose target{grasp.pose.position + lift_.position() * Vec3::UnitZ(),
                    grasp.pose.rotation * Quat(Eigen::AngleAxisd(turn_.position(), Vec3::UnitY()))};
  const Vec3 middle(0.0, 0.0, center_);
  const Vec3 arm = body.pose.rotation * middle;
  const Vec3 velocity = body.linear_velocity + body.angular_velocity.cross(arm);
  const Vec3 lag = target * middle - body.pose * middle;
  const Vec3 rise = lift_.velocity() * Vec3::UnitZ();
  Vec3 force = mass_ * (kStiffness * lag + kDamping * (rise - velocity) - view.gravity());
  force *= std::min(1.0, hand_force_ / std::max(force.norm(), 1e-9));
  const Eigen::AngleAxisd turn((target.rotation * body.pose.rotation.conjugate()).normalized());
  const double angle = std::remainder(turn.angle(), 2.0 * M_PI);
  const double moment = mass_ * (3.0 * radius_ * radius_ + height_ * height_) / 12.0;
  const Vec3 torque =
      moment * (kStiffness * angle * turn.axis() - kDamping * body.angular_velocity);
  outputs.push(body_, force, torque, body.pose * middle);
}

// Its drink presses on the bottom, half its depth over it.
void Cup::weigh(const View& view, Outputs& outputs) const {
  const double depth = content_ / kMilliliters / (M_PI * radius_ * radius_);
  const Vec3 middle(0.0, 0.0, floor_ + 0.5 * depth);
  // A push of 0 N removes the drink's weight from the support.
  const Vec3 weight = std::max(kDensity * content_, 1e-9) * view.gravity();
  outputs.push(body_, weight, Vec3::Zero(), view.link(body_).pose * middle);
}

void Cup::report(const View& view, Reading& state) const {
  state.set("content", content_);
  state.set("temperature", temperature_.value_or(view.ambient_temperature() - kKelvin));
  state.set("poured", poured_);
  state.set("tilt", tilt_of(view.link(body_).pose));
  state.set("held", grasp_.has_value());
}

void Cup::save(SavedParams& params) const {
  params.number("content", content_);
  params.number("poured", poured_);
  if (temperature_) params.number("temperature", *temperature_);
}

Nanoseconds Cup::idle_until(const View& view) const {
  if (pours_ || changed_ || unknown_air_ > 0) return 0;
  if (grasp_ && !(lift_.at(grasp_->height) && turn_.at(grasp_->tilt))) return 0;
  const double around = air(view);
  const bool cold = temperature_ && std::abs(*temperature_ - around) < kSameTemperature;
  return cold && climates(view).empty() ? kForever : due_.next(view.time());
}

ANGEN_REGISTER_DEVICE(
    Cup, Kind("cup", "A cup: its drink cools, weighs, and spills when it is tilted.")
             .model("cup")
             .example("set cup cup1 fill 200")
             .verb("Fill", "milliliters", "ml", {0.0, 1e5}, "adds a drink of fill_temperature")
             .verb("Empty", "takes the drink out")
             .verb("Lift", "height", "m", {0.0, 2.0}, "a hand lifts it over its support")
             .verb("Tilt", "angle", "rad", {0.0, M_PI}, "the hand tilts it towards its x axis")
             .verb("Put", "the hand puts it back upright and lets it go")
             .number("content", "ml", "that is in it")
             .shown(0)
             .number("temperature", "°C", "of cup and drink")
             .shown(1)
             .number("poured", "ml", "that has run out over its lip")
             .number("tilt", "rad", "of its axis from the vertical")
             .shown(2)
             .flag("held", "whether a hand holds it")
             .shown_as("held", ""))

}  // namespace angen::devices

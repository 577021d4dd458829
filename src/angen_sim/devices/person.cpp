#include "devices/person.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

#include "core/text.h"
#include "devices/metabolism.h"
#include "plugin/outputs.h"
#include "plugin/rooms.h"
#include "plugin/view.h"
#include "plugin/wiring.h"

namespace angen::devices {

namespace {

constexpr double kUsualStep = 1e-3;      // s
constexpr double kUsualMass = 70.0;      // kg, of a body of 1.8 m^2
constexpr double kMouth = 1.5;           // m above the floor, where its sound comes from
constexpr double kCelsiusZero = 273.15;  // K
constexpr double kMiddle = 0.9;          // m above its feet
constexpr double kFelt = 0.02;           // K
constexpr double kFeltHumidity = 0.5;    // percent
constexpr double kUsualHumidity = 50.0;  // percent, where the world has no climate
constexpr double kRoomAir = 295.15;      // K, at which …
constexpr double kSkinAtRest = 307.0;    // K … is that of head and hands
constexpr double kSkinPerKelvin = 0.12;  // share of the air's
constexpr double kCoveredSkin = 306.5;   // K, below clothing
constexpr double kClothingShare = 0.35;  // share of the way from the air to the skin
constexpr double kBareShare = 0.12;      // share of its surface: head and hands
constexpr double kGrounds = 20.0;        // m around all rooms, where people go
// N/m, of chest and pelvis: ISO/TS 15066:2016, table A.3, effective spring constant.
constexpr double kSideStiffness = 25e3;
constexpr Nanoseconds kAirPeriod = 10 * kSecond;
constexpr Range kSoundPower{-100.0, 200.0};

const char* const kModeEvents[] = {"stands", "walks", "blocked"};

// Why a place is none to go to; empty if it is one.
std::string why_not(const Point2& place, const Home& home) {
  Eigen::AlignedBox2d grounds;
  for (const Room& room : home.rooms) {
    for (const Point2& corner : room.outline) grounds.extend(corner);
  }
  if (grounds.isEmpty()) return "";
  const Point2 low = grounds.min().array() - kGrounds;
  const Point2 high = grounds.max().array() + kGrounds;
  if (Eigen::AlignedBox2d(low, high).contains(place)) return "";
  std::ostringstream why;
  why << place.x() << ' ' << place.y() << " is outside of the world; x is " << std::round(low.x())
      << " to " << std::round(high.x()) << ", y " << std::round(low.y()) << " to "
      << std::round(high.y()) << " m";
  return why.str();
}

}  // namespace

Path Person::read_path(Params& params) {
  std::vector<Path::Waypoint> waypoints;
  for (const std::vector<double>& row :
       params.rows("waypoint", 5, "s m m m rad", "t x y z yaw of a place on the way")) {
    waypoints.push_back({from_seconds(row[0]), row[1], row[2], row[4]});
    const std::size_t count = waypoints.size();
    if (count > 1 && waypoints[count - 1].time <= waypoints[count - 2].time) {
      throw params.error("waypoint", "the times of waypoints must rise");
    }
  }
  return Path(std::move(waypoints), params.flag("loop", true, "walks it again and again"));
}

void Person::configure(Params& params, Wiring& wiring) {
  path_ = read_path(params);
  clock_ =
      -from_seconds(params.number("delay_start", 0.0, "s", "time before the first", kNotNegative));
  const double on_path = params.number("path_time", to_seconds(clock_), "s",
                                       "where on its path it is at the start, as a time of its "
                                       "waypoints; before the first by delay_start unless given");
  if (params.has("path_time")) clock_ = from_seconds(on_path);
  paused_ = params.flag("stopped", false, "waits at the start, as after Stop");
  force_max_ = params.number("force_max", 150.0, "N", "greatest force of its legs", kPositive);
  const double mass = params.number("mass", kUsualMass, "kg", "its mass", kPositive);
  // Meeh's law: the surface of bodies of one shape.
  surface_ = std::pow(mass / kUsualMass, 2.0 / 3.0);
  step_sound_ =
      params.number("step_sound", 55.0, "dB",
                    "sound power level of its steps while it walks, over 1 pW", kSoundPower);
  speech_sound_ = params.number("speech_sound", 68.4, "dB",
                                "sound power level of its speech, over 1 pW", kSoundPower);
  speaks_ = spoke_ = params.flag("speaking", false, "speaks at the start, as after Speak");
  skin_ = params.number("skin_temperature", 307.0, "K",
                        "of head and hands, seen by PIRs; follows the air unless given", kPositive);
  clothing_ = params.number("clothing_temperature", 299.0, "K",
                            "of the rest of its surface; follows the air unless given", kPositive);
  skin_follows_ = !params.has("skin_temperature");
  clothing_follows_ = !params.has("clothing_temperature");
  surfaces_ = wiring.surfaces("");
  refresh_ = StateRefresh(params.number(
      "update_rate", 20.0, "Hz", "how often its state is published while it walks", kRefreshRate));
  avoids_ = params.flag(
      "avoid", true, "walks round obstacles that it sees, or stops before them; otherwise pushes");
  opens_doors_ = params.flag("opens_doors", true,
                             "opens shut doors on its way by hand; otherwise waits before them");
  const bool closes = params.flag("closes_doors", false, "shuts the doors that it has opened");
  doors_ = DoorUse(opens_doors_, closes);
  speed_ = params.number("speed", 1.0, "m/s", "of its walk to where it is sent", kPositive);
  for (const bool pushes : {false, true}) {
    const std::vector<std::vector<double>> sent =
        params.rows(pushes ? "push_to" : "go_to", 2, "m",
                    pushes ? "x y of its goal at the start, as after PushTo"
                           : "x y of its goal at the start, as after GoTo");
    if (!sent.empty()) order_ = Order{{sent.back()[0], sent.back()[1]}, pushes};
  }
  body_ = wiring.link("body");
  wiring.anatomy(body_, {true, kSideStiffness, Gait::visuals(), {}});
}

Verdict Person::command(const Command& command, const View& view) {
  if (command.verb == "Speak" || command.verb == "Quiet") {
    return Verdict::accept([this, speaks = command.verb == "Speak"] { speaks_ = speaks; });
  }
  if (command.verb == "GoTo" || command.verb == "PushTo") {
    const Order order{{command.values.at(0), command.values.at(1)}, command.verb == "PushTo"};
    if (std::string why = why_not(order.to, view.home()); !why.empty()) {
      return Verdict::reject(std::move(why));
    }
    return Verdict::accept([this, order] {
      order_ = order;
      paused_ = false;
      start_anew();
    });
  }
  return Verdict::accept([this, stop = command.verb == "Stop"] {
    paused_ = stop;
    if (stop || !order_ || !(order_->arrived || order_->unreachable)) return;
    order_.reset();
    start_anew();
  });
}

void Person::start_anew() {
  rejoin_.reset();
  aim_.reset();
  route_.reset();
  target_.reset();
  seen_.clear();
  failed_.clear();
  doors_.reset();
  scanned_at_ = -1;  // a way is planned at once
  stalled_ = away_until_ = 0;
  waits_ = waits_at_door_ = held_ = false;
  tries_ = errors_ = 0;
  came_left_ = std::numeric_limits<double>::infinity();
}

void Person::update(const View& view, Outputs& outputs) {
  const bool renew = refresh_.due(view.time(), view.step());
  late_ = std::max(0.0, 0.5 * (to_seconds(view.step()) - kUsualStep));
  const LinkView body = view.link(body_);
  if (!started_) start(body);
  gait_.advance(body.pose, body.linear_velocity.head<2>().norm());
  feel_air(view, outputs);
  if (speaks_ != spoke_) outputs.event(speaks_ ? "speaks" : "quiet", "");
  spoke_ = speaks_;
  if (paused_) {
    if (!resting_) stand(outputs);
    if (renew) show(Mode::kStanding, view.link(body_), true, outputs);
    return;
  }
  if (order_) return go(view, renew, outputs);
  const Path::Place place = path_.at(clock_);
  if (resting_ && place.still() && !renew) {
    clock_ += view.step();
    return;
  }
  walk(place, view, renew, outputs);
}

// Skin and clothing follow the air around; rays hit one surface, which radiates as both do.
void Person::feel_air(const View& view, Outputs& outputs) {
  const Nanoseconds now = view.time() / kAirPeriod;
  if (now == felt_at_) return;
  felt_at_ = now;
  const Vec3 middle = view.link(body_).pose.position + kMiddle * Vec3::UnitZ();
  const AirHere here = air_at(view, middle);
  const bool known = !std::isnan(here.temperature);
  const double air = known ? here.temperature + kCelsiusZero : view.ambient_temperature();
  const double humidity = known ? here.humidity : kUsualHumidity;
  if (std::abs(air - air_) < kFelt && std::abs(humidity - humidity_) < kFeltHumidity) return;
  humidity_ = humidity;
  air_ = air;
  if (skin_follows_) skin_ = kSkinAtRest + kSkinPerKelvin * (air - kRoomAir);
  if (clothing_follows_) clothing_ = air + kClothingShare * (kCoveredSkin - air);
  const double mean =
      std::pow(kBareShare * std::pow(skin_, 4) + (1.0 - kBareShare) * std::pow(clothing_, 4), 0.25);
  for (const SurfaceRef surface : surfaces_) outputs.temperature(surface, mean, mean, 0.0);
}

void Person::pose_limbs(std::vector<Pose>& limbs) const {
  for (std::size_t i = 0; i < limbs.size(); ++i) limbs[i] = gait_.limb(static_cast<int>(i));
}

void Person::start(const LinkView& body) {
  started_ = true;
  came_to_ = body.pose.position.head<2>();
  shown_ = body;
  if (!path_.empty()) return;
  const Vec3& here = body.pose.position;
  path_ = Path({{0, here.x(), here.y(), yaw_of(body.pose.rotation)}}, false);
}

void Person::stand(Outputs& outputs) {
  outputs.drive(body_, Vec3::Zero(), 0.0, force_max_);
  resting_ = true;
  stalled_ = 0;
}

void Person::show(Mode mode, const LinkView& body, bool renew, Outputs& outputs) {
  if (mode != mode_) {
    mode_ = mode;
    outputs.event(kModeEvents[static_cast<int>(mode)], "");
    renew = true;
  }
  if (renew) shown_ = body;
}

Nanoseconds Person::idle_until(const View& view) const {
  const Nanoseconds needed = rests_until(view);
  if (climates(view).empty()) return needed;
  return std::min(needed, (view.time() / kAirPeriod + 1) * kAirPeriod);
}

Nanoseconds Person::rests_until(const View& view) const {
  if (!resting_ || view.time() < away_until_) return 0;
  const bool waits = waits_ || waits_at_door_;
  if (mode_ != Mode::kStanding && !waits) return 0;
  const LinkView body = view.link(body_);
  if (body.pose != shown_.pose || body.linear_velocity != shown_.linear_velocity) {
    return refresh_.next(view.time());
  }
  if (paused_) return kForever;
  if (waits) return (view.time() / kSecond + 1) * kSecond;
  const Vec3& at = body.pose.position;
  if (order_) {
    if (order_->unreachable) return kForever;
    const bool stays = order_->arrived && (order_->to - at.head<2>()).norm() < order_->stays_within;
    return stays ? kForever : refresh_.next(view.time());
  }
  const Path::Place place = path_.at(clock_);
  const bool near = std::hypot(place.x - at.x(), place.y - at.y()) < kPushedAway;
  if (!near) return refresh_.next(view.time());
  const Nanoseconds leaves = path_.still_until(clock_);
  return leaves == kForever ? kForever : view.time() + view.step() + (leaves - clock_);
}

void Person::save(SavedParams& params) const {
  params.number("path_time", to_seconds(clock_));
  params.flag("stopped", paused_);
  params.flag("speaking", speaks_);
  params.unset("go_to");
  params.unset("push_to");
  if (!order_) return;
  params.text(order_->pushes ? "push_to" : "go_to",
              number_text(order_->to.x()) + " " + number_text(order_->to.y()));
}

void Person::skip(Nanoseconds time) {
  if (!paused_ && !order_ && !waits_ && !waits_at_door_) clock_ += time;
}

void Person::report(const View& view, Reading& state) const {
  const LinkView body = started_ ? shown_ : view.link(body_);
  state.set("mode", choice_of(mode_, kPersonModes));
  state.set("x", body.pose.position.x());
  state.set("y", body.pose.position.y());
  state.set("z", body.pose.position.z());
  state.set("yaw", yaw_of(body.pose.rotation));
  state.set("speed", body.linear_velocity.head<2>().norm());
  state.set("unreachable", order_ && order_->unreachable);
  state.set("speaking", speaks_);
  state.set("sound_power_level", sound());
  state.set("position", std::vector<double>{0.0, 0.0, kMouth});
  const double air = air_ > 0.0 ? air_ : view.ambient_temperature();
  const Metabolism given = metabolism(activity(), air - kCelsiusZero, humidity_);
  state.set("heat", surface_ * given.heat);
  state.set("vapor", surface_ * given.vapor);
}

// W/m^2 of its body.
double Person::activity() const {
  const double speed = shown_.linear_velocity.head<2>().norm();
  return metabolic_rate(mode_ == Mode::kWalking ? speed : 0.0);
}

// dB over 1 pW, of steps and speech together.
double Person::sound() const {
  const double steps = mode_ == Mode::kWalking ? std::pow(10.0, step_sound_ / 10.0) : 0.0;
  const double speech = speaks_ ? std::pow(10.0, speech_sound_ / 10.0) : 0.0;
  return 10.0 * std::log10(steps + speech);
}

}  // namespace angen::devices

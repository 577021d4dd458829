#include "devices/person.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "plugin/register.h"

namespace angen::devices {

namespace {

constexpr double kMaxLag = 0.3;       // m behind the path: further, and the path waits
constexpr double kAhead = 0.35;       // s: it makes for where its path will be then
constexpr double kTurnGain = 6.0;     // 1/s, from the wrong heading to a yaw rate
constexpr double kMaxTurn = 3.0;      // rad/s
constexpr double kReturnSpeed = 0.8;  // m/s, back to a path it was pushed off
constexpr double kCatchUp = 1.3;      // times the path's own speed
constexpr double kThere = 0.01;       // m: nearer than this it may stand
constexpr double kFacing = 0.02;      // rad
constexpr double kPushedAway = 0.1;   // m: further than this it walks back
constexpr double kNearPath = 0.1;     // m: nearer than this it is not held
constexpr double kProgress = 0.05;    // m: less than this in kStallTime is none
constexpr Nanoseconds kStallTime = kSecond;
constexpr Nanoseconds kPatience = 3 * kSecond;  // held for so long, it makes room
constexpr Nanoseconds kAway = 5 * kSecond;      // and comes again: a door opens in less
constexpr double kStepBack = 1.2;               // m, out of the way of a leaf that opens towards it
constexpr Nanoseconds kLookBack = kSecond / 20;
constexpr int kMostLooks = 200;
constexpr double kMouth = 1.5;  // m above the floor, where its sound comes from
constexpr Range kSoundPower{-100.0, 200.0};

const char* const kModeNames[] = {"STANDING", "WALKING", "BLOCKED"};
const char* const kModeEvents[] = {"stands", "walks", "blocked"};

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
  clock_ = -from_seconds(
      params.number("delay_start", 0.0, "s", "stands so long before the first", kNotNegative));
  const double on_path = params.number("path_time", to_seconds(clock_), "s",
                                       "where on its path it is at the start, as a time of its "
                                       "waypoints; before the first by delay_start unless given");
  if (params.has("path_time")) clock_ = from_seconds(on_path);
  paused_ = params.flag("stopped", false, "stands at the start, as after Stop");
  force_max_ = params.number("force_max", 150.0, "N", "greatest force of its legs", kPositive);
  params.number("mass", 70.0, "kg", "its mass", kPositive);
  step_sound_ =
      params.number("step_sound", 55.0, "dB",
                    "sound power level of its steps while it walks, over 1 pW", kSoundPower);
  speech_sound_ = params.number("speech_sound", 68.4, "dB",
                                "sound power level of its speech, over 1 pW", kSoundPower);
  speaks_ = spoke_ = params.flag("speaking", false, "speaks at the start, as after Speak");
  params.number("skin_temperature", 307.0, "K", "of head and hands, seen by PIRs", kPositive);
  params.number("clothing_temperature", 299.0, "K", "of the rest of its surface", kPositive);
  refresh_ = Refresh(params.number(
      "update_rate", 20.0, "Hz", "how often its state is published while it walks", kRefreshRate));
  params.text("device_name", "", "the name commands use, instead of the actor's");
  body_ = wiring.link("body");
}

Verdict Person::command(const Command& command, const View&) {
  if (command.verb == "Speak" || command.verb == "Quiet") {
    return Verdict::accept([this, speaks = command.verb == "Speak"] { speaks_ = speaks; });
  }
  return Verdict::accept([this, stop = command.verb == "Stop"] { paused_ = stop; });
}

void Person::update(const View& view, Outputs& outputs) {
  const bool renew = refresh_.due(view.time(), view.step());
  if (!started_) start(view.link(body_));
  if (speaks_ != spoke_) outputs.event(speaks_ ? "speaks" : "quiet", "");
  spoke_ = speaks_;
  if (paused_) {
    if (!resting_) stand(outputs);
    if (renew) show(Mode::kStanding, view.link(body_), true, outputs);
    return;
  }
  const Path::Place place = path_.at(clock_);
  if (resting_ && place.still() && !renew) {
    clock_ += view.step();
    return;
  }
  walk(place, view, renew, outputs);
}

void Person::start(const LinkView& body) {
  started_ = true;
  came_to_ = body.pose.position;
  shown_ = body;
  if (!path_.empty()) return;
  const Vec3& here = body.pose.position;
  path_ = Path({{0, here.x(), here.y(), yaw_of(body.pose.rotation)}}, false);
}

void Person::walk(const Path::Place& place, const View& view, bool renew, Outputs& outputs) {
  const LinkView body = view.link(body_);
  if (stalled_ >= kPatience) make_room(body, view.time());
  if (view.time() < away_until_) {
    head_for(back_to_ - body.pose.position, kReturnSpeed, 0.0, outputs);
    came_to_ = body.pose.position;
    show(Mode::kBlocked, body, renew, outputs);
    return;
  }
  const Path::Place goal = path_.at(clock_ + from_seconds(kAhead));
  const Vec3& at = body.pose.position;
  const Vec3 to_goal(goal.x - at.x(), goal.y - at.y(), 0.0);
  const double lag = std::hypot(place.x - at.x(), place.y - at.y());
  const double turn = std::remainder(goal.yaw - yaw_of(body.pose.rotation), 2.0 * M_PI);
  // Ahead of its place is no reason to wait, so it is the way to the goal that counts.
  const bool waits = to_goal.norm() > kMaxLag + std::hypot(goal.x - place.x, goal.y - place.y);
  if (!waits) clock_ += view.step();
  watch(at, goal, lag < (place.still() ? kThere : kNearPath), view.step());

  const bool there = lag < kThere && std::abs(turn) < kFacing;
  if (place.still() && (there || (resting_ && lag < kPushedAway))) {
    if (!resting_) stand(outputs);
    stalled_ = 0;
    show(Mode::kStanding, body, renew, outputs);
    return;
  }
  const double fastest = std::max(kReturnSpeed, kCatchUp * std::hypot(place.vx, place.vy));
  head_for(to_goal, fastest, turn, outputs);
  show(stalled_ >= kStallTime ? Mode::kBlocked : Mode::kWalking, body, renew, outputs);
}

void Person::head_for(const Vec3& way, double fastest, double turn, Outputs& outputs) {
  resting_ = false;
  Vec3 velocity = Vec3(way.x(), way.y(), 0.0) / kAhead;
  if (velocity.norm() > fastest) velocity *= fastest / velocity.norm();
  outputs.drive(body_, velocity, std::clamp(kTurnGain * turn, -kMaxTurn, kMaxTurn), force_max_);
}

// A door that opens towards whoever leans on it could never be opened: after a while the person
// goes back the way it came, and tries again.
void Person::make_room(const LinkView& body, Nanoseconds now) {
  stalled_ = 0;
  away_until_ = now + kAway;
  back_to_ = body.pose.position;
  Nanoseconds time = clock_;
  for (int look = 0; look < kMostLooks; ++look, time -= kLookBack) {
    const Path::Place place = path_.at(time);
    back_to_.head<2>() << place.x, place.y;
    if ((back_to_ - body.pose.position).head<2>().norm() >= kStepBack) return;
  }
}

// Nearer to the goal is progress; along a leaf that one leans on is none.
void Person::watch(const Vec3& at, const Path::Place& goal, bool on_path, Nanoseconds step) {
  const auto way_from = [&](const Vec3& from) {
    return std::hypot(goal.x - from.x(), goal.y - from.y());
  };
  if (on_path || way_from(came_to_) - way_from(at) > kProgress) {
    came_to_ = at;
    stalled_ = 0;
  } else {
    stalled_ += step;
  }
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
  if (!resting_ || mode_ != Mode::kStanding || view.time() < away_until_) return 0;
  const LinkView body = view.link(body_);
  if (body.pose != shown_.pose || body.linear_velocity != shown_.linear_velocity) {
    return refresh_.next(view.time());
  }
  if (paused_) return kForever;
  const Path::Place place = path_.at(clock_);
  const Vec3& at = body.pose.position;
  const bool near = std::hypot(place.x - at.x(), place.y - at.y()) < kPushedAway;
  if (!near) return refresh_.next(view.time());
  const Nanoseconds leaves = path_.still_until(clock_);
  return leaves == kForever ? kForever : view.time() + view.step() + (leaves - clock_);
}

void Person::save(SavedParams& params) const {
  params.number("path_time", to_seconds(clock_));
  params.flag("stopped", paused_);
  params.flag("speaking", speaks_);
}

void Person::skip(Nanoseconds time) {
  if (!paused_) clock_ += time;
}

void Person::report(const View& view, Reading& state) const {
  const LinkView body = started_ ? shown_ : view.link(body_);
  state.set("mode", choice_of(mode_, kModeNames));
  state.set("x", body.pose.position.x());
  state.set("y", body.pose.position.y());
  state.set("z", body.pose.position.z());
  state.set("yaw", yaw_of(body.pose.rotation));
  state.set("speed", body.linear_velocity.head<2>().norm());
  state.set("speaking", speaks_);
  state.set("sound_power_level", sound());
  state.set("position", std::vector<double>{0.0, 0.0, kMouth});
}

// dB over 1 pW, of steps and speech together.
double Person::sound() const {
  const double steps = mode_ == Mode::kWalking ? std::pow(10.0, step_sound_ / 10.0) : 0.0;
  const double speech = speaks_ ? std::pow(10.0, speech_sound_ / 10.0) : 0.0;
  return 10.0 * std::log10(steps + speech);
}

const Kind& PersonPlugin::kind() const {
  static const Kind kind = Kind("person", "A person who walks a path.")
                               .example("set person walker stop")
                               .verb("Stop", "stands still where the person is")
                               .verb("Go", "walks on along the path")
                               .verb("Speak", "speaks until Quiet")
                               .verb("Quiet", "speaks no more")
                               .choice("mode", {std::begin(kModeNames), std::end(kModeNames)},
                                       "BLOCKED: something stands in the way")
                               .shown()
                               .number("x", "m", "in the world")
                               .shown(2)
                               .number("y", "m", "in the world")
                               .shown(2)
                               .number("z", "m", "in the world")
                               .number("yaw", "rad", "in the world")
                               .number("speed", "m/s", "horizontal")
                               .shown(2)
                               .flag("speaking", "whether the person speaks")
                               .number("sound_power_level", "dB",
                                       "of steps and speech, over 1 pW; minus infinity: silent")
                               .numbers("position", "m", "of the mouth, in the model's frame");
  return kind;
}

bool PersonPlugin::serves(const ModelInfo& model) const {
  return std::find(model.links.begin(), model.links.end(), "body") != model.links.end();
}

}  // namespace angen::devices

ANGEN_REGISTER_PLUGIN(angen::devices::PersonPlugin)

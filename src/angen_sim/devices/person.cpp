#include "devices/person.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/text.h"

namespace angen::devices {

namespace {

constexpr double kMaxPathLag = 0.3;   // m behind the path: further, and the path waits
constexpr double kAhead = 0.35;       // s: it makes for where its path will be then
constexpr double kTurnGain = 6.0;     // 1/s, from the wrong heading to a yaw rate
constexpr double kMaxTurn = 3.0;      // rad/s
constexpr double kReturnSpeed = 0.8;  // m/s, back to a path it was pushed off
constexpr double kCatchUp = 1.3;      // times the path's own speed
constexpr double kThere = 0.01;       // m: tolerance of its goal
constexpr double kFacing = 0.02;      // rad
constexpr double kPushedAway = 0.1;   // m: further than this it walks back
constexpr double kNearPath = 0.1;     // m: nearer than this it is not held
constexpr double kProgress = 0.05;    // m: less than this in kStallTime is none
constexpr Nanoseconds kStallTime = kSecond;
constexpr Nanoseconds kTimeout = 3 * kSecond;  // after this time it makes room
constexpr Nanoseconds kAway = 5 * kSecond;     // and comes again: a door opens in less
constexpr double kStepBack = 1.2;              // m, out of the way of a leaf that opens towards it
constexpr Nanoseconds kBackStep = kSecond / 20;
constexpr int kMaxBackSteps = 200;
constexpr int kScansPerPlan = 3;
constexpr double kArrived = 0.03;    // m: nearer than this an order is carried out
constexpr double kNearRejoin = 0.3;  // m
constexpr double kAround = 0.3;      // m: farther than this is progress on a way round
constexpr double kPushSpeed = 0.3;   // m/s, against a thing that it shall push
constexpr Nanoseconds kPathAhead = 7 * kSecond / 5;  // of its path, checked for obstacles
constexpr Nanoseconds kRejoinWithin = 6 * kSecond;
constexpr double kMouth = 1.5;  // m above the floor, where its sound comes from
constexpr Range kSoundPower{-100.0, 200.0};

double turn_towards(const Surroundings::Vec2& velocity, const LinkView& body) {
  if (velocity.norm() < 0.05) return 0.0;
  const double heading = std::atan2(velocity.y(), velocity.x());
  return std::remainder(heading - yaw_of(body.pose.rotation), 2.0 * M_PI);
}

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
  clock_ =
      -from_seconds(params.number("delay_start", 0.0, "s", "time before the first", kNotNegative));
  const double on_path = params.number("path_time", to_seconds(clock_), "s",
                                       "where on its path it is at the start, as a time of its "
                                       "waypoints; before the first by delay_start unless given");
  if (params.has("path_time")) clock_ = from_seconds(on_path);
  paused_ = params.flag("stopped", false, "waits at the start, as after Stop");
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
  avoids_ = params.flag(
      "avoid", true, "walks round obstacles that it sees, or stops before them; otherwise pushes");
  speed_ = params.number("speed", 1.0, "m/s", "of its walk to where it is sent", kPositive);
  for (const bool pushes : {false, true}) {
    const std::vector<std::vector<double>> sent =
        params.rows(pushes ? "push_to" : "go_to", 2, "m",
                    pushes ? "x y of its goal at the start, as after PushTo"
                           : "x y of its goal at the start, as after GoTo");
    if (!sent.empty()) order_ = Order{{sent.back()[0], sent.back()[1]}, pushes};
  }
  body_ = wiring.link("body");
}

Verdict Person::command(const Command& command, const View&) {
  if (command.verb == "Speak" || command.verb == "Quiet") {
    return Verdict::accept([this, speaks = command.verb == "Speak"] { speaks_ = speaks; });
  }
  if (command.verb == "GoTo" || command.verb == "PushTo") {
    const Order order{{command.values.at(0), command.values.at(1)}, command.verb == "PushTo"};
    return Verdict::accept([this, order] {
      order_ = order;
      paused_ = false;
      rejoin_.reset();
      aim_.reset();
      scanned_at_ = -1;  // a way is planned at once
      stalled_ = away_until_ = 0;
    });
  }
  return Verdict::accept([this, stop = command.verb == "Stop"] {
    paused_ = stop;
    if (!stop && order_ && order_->arrived) order_.reset();
  });
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
  if (order_) return go(view, renew, outputs);
  const Path::Place place = path_.at(clock_);
  if (resting_ && place.still() && !renew) {
    clock_ += view.step();
    return;
  }
  walk(place, view, renew, outputs);
}

void Person::start(const LinkView& body) {
  started_ = true;
  came_to_ = body.pose.position.head<2>();
  shown_ = body;
  if (!path_.empty()) return;
  const Vec3& here = body.pose.position;
  path_ = Path({{0, here.x(), here.y(), yaw_of(body.pose.rotation)}}, false);
}

void Person::walk(const Path::Place& place, const View& view, bool renew, Outputs& outputs) {
  const LinkView body = view.link(body_);
  if (steps_back(body, view, renew, outputs)) return;
  const Vec2 at = body.pose.position.head<2>();
  const bool near =
      resting_ && place.still() && Vec2(place.x - at.x(), place.y - at.y()).norm() < kPushedAway;
  if (avoids_ && !near) {
    const Scan scan = scan_surroundings(body, view);
    if (scan == Scan::kPlans && rejoin_) {
      const Path::Place end = path_.at(*rejoin_);
      aim_ = way_for(at, {end.x, end.y});
    }
    if (scan != Scan::kNone) find_rejoin(at);
  }
  if (rejoin_) return go_round(body, view, renew, outputs);
  const Path::Place goal = path_.at(clock_ + from_seconds(kAhead));
  const Vec2 to(goal.x, goal.y);
  const double lag = std::hypot(place.x - at.x(), place.y - at.y());
  const double turn = std::remainder(goal.yaw - yaw_of(body.pose.rotation), 2.0 * M_PI);
  // Ahead of its place is no reason to wait, so it is the way to the goal that counts.
  const bool waits =
      (to - at).norm() > kMaxPathLag + std::hypot(goal.x - place.x, goal.y - place.y);
  if (!waits) clock_ += view.step();
  note_progress(at, to, lag < (place.still() ? kThere : kNearPath), view.step());

  const bool there = lag < kThere && std::abs(turn) < kFacing;
  if (place.still() && (there || (resting_ && lag < kPushedAway))) {
    if (!resting_) stand(outputs);
    stalled_ = 0;
    show(Mode::kStanding, body, renew, outputs);
    return;
  }
  aim_.reset();
  const double fastest = std::max(kReturnSpeed, kCatchUp * std::hypot(place.vx, place.vy));
  head_for(steer(body, to, fastest), turn, outputs);
  show(stalled_ >= kStallTime ? Mode::kBlocked : Mode::kWalking, body, renew, outputs);
}

// The path's clock advances up to the point of return, and waits for the person there.
void Person::go_round(const LinkView& body, const View& view, bool renew, Outputs& outputs) {
  const Vec2 at = body.pose.position.head<2>();
  const Path::Place end = path_.at(*rejoin_);
  const Vec2 to(end.x, end.y);
  const Nanoseconds last = *rejoin_ - from_seconds(kAhead);
  if (clock_ < last) clock_ += view.step();
  if (clock_ >= last && (to - at).norm() < kNearRejoin) rejoin_.reset();
  note_progress(at, to, false, view.step());
  const Vec2 velocity = steer(body, to, std::max(kReturnSpeed, std::hypot(end.vx, end.vy)));
  head_for(velocity, turn_towards(velocity, body), outputs);
  show(stalled_ >= kStallTime ? Mode::kBlocked : Mode::kWalking, body, renew, outputs);
}

void Person::go(const View& view, bool renew, Outputs& outputs) {
  const LinkView body = view.link(body_);
  const Vec2 at = body.pose.position.head<2>();
  const double way = (order_->to - at).norm();
  if (way < (order_->arrived && resting_ ? kPushedAway : kArrived)) {
    order_->arrived = true;
    if (!resting_) stand(outputs);
    show(Mode::kStanding, body, renew, outputs);
    return;
  }
  if (steps_back(body, view, renew, outputs)) return;
  if (scan_surroundings(body, view) == Scan::kPlans) aim_ = way_for(at, order_->to);
  note_progress(at, order_->to, false, view.step());
  const Vec2 velocity = steer(body, order_->to, speed_);
  head_for(velocity, turn_towards(velocity, body), outputs);
  show(stalled_ >= kStallTime ? Mode::kBlocked : Mode::kWalking, body, renew, outputs);
}

// A door that opens towards a person before it needs room: after a while the person steps back
// the way it came, and tries again.
bool Person::steps_back(const LinkView& body, const View& view, bool renew, Outputs& outputs) {
  if (stalled_ >= kTimeout) make_room(body, view.time());
  if (view.time() >= away_until_) return false;
  scan_surroundings(body, view);
  const Vec2 at = body.pose.position.head<2>();
  aim_.reset();
  head_for(steer(body, back_to_, kReturnSpeed), 0.0, outputs);
  came_to_ = at;
  show(Mode::kBlocked, body, renew, outputs);
  return true;
}

// Ten times a second; a way round is planned with each third scan.
Person::Scan Person::scan_surroundings(const LinkView& body, const View& view) {
  if (!avoids_ && !order_) return Scan::kNone;
  const Nanoseconds now = view.time() / kScanPeriod;
  if (now == scanned_at_) return Scan::kNone;
  const bool plans = now % kScansPerPlan == 0 || now - scanned_at_ > 1;
  scanned_at_ = now;
  braking_.invalidate();
  surroundings_.scan(view, body.pose.position);
  return plans ? Scan::kPlans : Scan::kScanned;
}

std::optional<Person::Vec2> Person::way_for(const Vec2& at, const Vec2& to) const {
  if ((order_ && order_->pushes) || surroundings_.is_free(at, to)) return std::nullopt;
  return surroundings_.way_round(at, to);
}

// If an obstacle is on the path ahead, or on the way to it: the first place behind the obstacle.
void Person::find_rejoin(const Vec2& at) {
  const auto place_at = [&](Nanoseconds time) {
    const Path::Place place = path_.at(time);
    return Vec2(place.x, place.y);
  };
  const Nanoseconds ahead = from_seconds(kAhead);
  bool met = !surroundings_.is_free(at, place_at(clock_ + ahead));
  for (Nanoseconds t = ahead; t <= kPathAhead; t += ahead) {
    met = met || surroundings_.is_occupied(place_at(clock_ + t));
  }
  if (!met) return rejoin_.reset();
  if (rejoin_ && !surroundings_.is_occupied(place_at(*rejoin_))) return;
  rejoin_.reset();
  bool behind = false;
  for (Nanoseconds t = ahead; t < kRejoinWithin; t += kScanPeriod) {
    const Vec2 place = place_at(clock_ + t);
    if ((place - at).norm() > Surroundings::kSight) return;
    if (surroundings_.is_occupied(place)) {
      behind = true;
    } else if (behind || !surroundings_.is_free(at, place)) {
      aim_ = surroundings_.way_round(at, place);
      if (aim_) rejoin_ = clock_ + t;
      return;
    }
  }
}

// The velocity towards a place, or the first one of a way round.
Person::Vec2 Person::steer(const LinkView& body, const Vec2& to, double fastest) {
  const Vec2 at = body.pose.position.head<2>();
  const Vec2 way = aim_.value_or(to) - at;
  const double length = way.norm();
  if (length < 1e-9) return Vec2::Zero();
  const Vec2 direction = way / length;
  double speed = aim_ ? fastest : std::min(fastest, length / kAhead);
  if (avoids_ || order_) speed = slowed(at, direction, speed);
  return speed * direction;
}

// It stops before obstacles that it sees, unless it shall push them.
double Person::slowed(const Vec2& at, const Vec2& direction, double speed) {
  const double allowed = braking_.limit(surroundings_, at, direction, speed);
  const bool pushes = !avoids_ || (order_ && order_->pushes);
  return std::min(speed, pushes ? std::max(allowed, kPushSpeed) : allowed);
}

void Person::head_for(const Vec2& velocity, double turn, Outputs& outputs) {
  resting_ = false;
  outputs.drive(body_, {velocity.x(), velocity.y(), 0.0},
                std::clamp(kTurnGain * turn, -kMaxTurn, kMaxTurn), force_max_);
}

void Person::make_room(const LinkView& body, Nanoseconds now) {
  stalled_ = 0;
  away_until_ = now + kAway;
  const Vec2 at = body.pose.position.head<2>();
  back_to_ = at;
  if (order_) {
    back_to_ -= kStepBack * (order_->to - at).normalized();
    return;
  }
  Nanoseconds time = clock_;
  for (int i = 0; i < kMaxBackSteps; ++i, time -= kBackStep) {
    const Path::Place place = path_.at(time);
    back_to_ << place.x, place.y;
    if ((back_to_ - at).norm() >= kStepBack) return;
  }
}

// Nearer to the goal is progress, and the way round something; along a leaf that one leans on is
// none.
void Person::note_progress(const Vec2& at, const Vec2& goal, bool on_path, Nanoseconds step) {
  const bool nearer = (goal - came_to_).norm() - (goal - at).norm() > kProgress;
  const bool around = aim_ && (at - came_to_).norm() > kAround;
  if (on_path || nearer || around) {
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
  const Vec3& at = body.pose.position;
  if (order_) {
    const bool stays = order_->arrived && (order_->to - at.head<2>()).norm() < kPushedAway;
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
  if (!paused_ && !order_) clock_ += time;
}

void Person::report(const View& view, Reading& state) const {
  const LinkView body = started_ ? shown_ : view.link(body_);
  state.set("mode", choice_of(mode_, kPersonModes));
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

}  // namespace angen::devices

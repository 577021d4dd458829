#include "people/person.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/text.h"
#include "plugin/outputs.h"
#include "plugin/rooms.h"
#include "plugin/view.h"
#include "plugin/wiring.h"

namespace angen::people {

namespace {

// N/m, of chest and pelvis: ISO/TS 15066:2016, table A.3, effective spring constant.
constexpr double kSideStiffness = 25e3;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kBesideSeat = 1.5;  // m
constexpr int kNoFloor = std::numeric_limits<int>::min();

Path read_path(Params& params) {
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

Stroll read_stroll(Params& params) {
  Path path = read_path(params);
  const Nanoseconds delay =
      -from_seconds(params.number("delay_start", 0.0, "s", "time before the first", kNotNegative));
  const double given = params.number("path_time", to_seconds(delay), "s",
                                     "where on its path it is at the start, as a time of its "
                                     "waypoints; before the first by delay_start unless given");
  return {std::move(path), params.has("path_time") ? from_seconds(given) : delay};
}

std::optional<Errand> read_errand(Params& params) {
  std::optional<Errand> errand;
  for (const bool pushes : {false, true}) {
    const std::vector<std::vector<double>> sent =
        params.rows(pushes ? "push_to" : "go_to", 2, "m",
                    pushes ? "x y of its goal at the start, as after PushTo"
                           : "x y of its goal at the start, as after GoTo");
    if (!sent.empty()) errand.emplace(Errand::Vec2(sent.back()[0], sent.back()[1]), pushes);
  }
  return errand;
}

// The pose is that of its model.
std::optional<Seat> read_seat(Params& params) {
  const std::string word = params.choice(
      "posture", kPostures[0], {std::begin(kPostures), std::end(kPostures)}, "at the start");
  const std::vector<std::vector<double>> stands =
      params.rows("stands_at", 3, "m", "x y z where it gets up to, of one who sits or lies");
  if (word == kPostures[0]) return std::nullopt;
  const Vec3 unknown = Vec3::Constant(kUnknown);
  Seat seat{
      word == kPostures[1] ? Posture::kSit : Posture::kLie, {unknown, Quat::Identity()}, unknown};
  if (!stands.empty()) seat.stand = Vec3(stands.back()[0], stands.back()[1], stands.back()[2]);
  return seat;
}

}  // namespace

Nanoseconds Person::Step::now() const { return view.time(); }

void Person::configure(Params& params, Wiring& wiring) {
  stroll_ = read_stroll(params);
  paused_ = params.flag("stopped", false, "waits at the start, as after Stop");
  const double force =
      params.number("force_max", 150.0, "N", "greatest force of its legs", kPositive);
  gives_.configure(params, wiring);
  refresh_ = devices::StateRefresh(params.number("update_rate", 20.0, "Hz",
                                                 "how often its state is published while it walks",
                                                 devices::kRefreshRate));
  avoids_ = params.flag(
      "avoid", true, "walks round obstacles that it sees, or stops before them; otherwise pushes");
  const bool opens = params.flag(
      "opens_doors", true, "opens shut doors on its way by hand; otherwise waits before them");
  const bool closes = params.flag("closes_doors", false, "shuts the doors that it walks through");
  doors_ = DoorUse(opens, closes);
  navigator_ = Navigator(maps_, opens);
  speed_ = params.number("speed", 1.0, "m/s", "of its walk to where it is sent", kPositive);
  errand_ = read_errand(params);
  const int floor =
      params.integer("go_floor", kNoFloor, "", "floor of go_to; its own unless given");
  if (errand_ && floor != kNoFloor) floor_ = floor;
  link_ = wiring.link("body");
  walker_ = Walker(link_, force);
  behave();
  seat_ = read_seat(params);
  if (seat_) paused_ = true;
  std::vector<Anatomy::Names> postures(3);
  for (const std::string& name : wiring.collision_names(link_)) {
    const bool sits = name.rfind("sit_", 0) == 0;
    const bool lies = name.rfind("lie_", 0) == 0;
    can_sit_ = can_sit_ || sits || lies;
    postures[sits ? 1 : lies ? 2 : 0].push_back(name);
  }
  if (!can_sit_) postures.clear();
  wiring.anatomy(link_, {true, kSideStiffness, Gait::visuals(), postures});
}

Verdict Person::command(const Command& command, const View& view) {
  if (command.verb == "Speak" || command.verb == "Quiet") {
    return Verdict::accept([this, speaks = command.verb == "Speak"] { gives_.speak(speaks); });
  }
  if (command.verb == "CloseDoors" || command.verb == "LeaveDoors") {
    return Verdict::accept([this, closes = command.verb == "CloseDoors"] { doors_.close(closes); });
  }
  if (command.verb == "Sit" || command.verb == "Lie" || command.verb == "Stand") {
    return command_posture(command, view);
  }
  if (command.verb == "GoTo" || command.verb == "PushTo") {
    Found found = find_goal(command, view, stands_at(view).position);
    if (!found.why_not.empty()) return Verdict::reject(std::move(found.why_not));
    return Verdict::accept([this, goal = found.goal, pushes = command.verb == "PushTo"] {
      floor_ = goal.floor;
      ride_.reset();
      paused_ = false;
      walk_to(goal.to, pushes);
    });
  }
  return Verdict::accept([this, verb = command.verb] {
    paused_ = verb == "Stop";
    if (verb == "Follow") {
      ride_.reset();
      floor_.reset();
    }
    const bool goes_on = ride_ || !errand_ || !errand_->is_over();
    if (paused_ || (verb == "Go" && goes_on)) return;
    errand_.reset();
    start_anew();
  });
}

void Person::walk_to(const Vec2& to, bool pushes) {
  errand_.emplace(to, pushes);
  start_anew();
}

void Person::start_anew() {
  behave();
  stroll_.stay_on_path();
  walker_.aim_straight();
  walker_.look_anew();  // a way is planned at once
  navigator_.forget();
  doors_.reset();
  progress_.reset();
  state_ = Walks{};
}

// Who was sent looks in any case.
void Person::behave() {
  const bool pushes = errand_ && errand_->pushes();
  walker_.behave({avoids_ || errand_, !pushes, !avoids_ || pushes});
}

void Person::update(const View& view, Outputs& outputs) {
  const bool renew = refresh_.due(view.time(), view.step());
  walker_.begin(view.step());
  const Step step{view, view.link(link_), outputs, renew};
  if (!started_) start(step);
  gives_.update(view, step.body, outputs);
  if (seat_ && sits(step)) return;
  if (paused_) {
    if (!walker_.rests()) stand(outputs);
    if (renew) show(Mode::kStanding, step);
    return;
  }
  if (errand_) {
    if (floor_) begin_ride(step);
    if (!ride_ || follow_ride(step)) run_errand(step);
    return;
  }
  const Path::Place place = stroll_.now();
  if (walker_.rests() && place.still() && !renew) return stroll_.advance(view.step());
  stroll(place, step);
}

void Person::start(const Step& step) {
  const LinkView& body = step.body;
  started_ = true;
  progress_.count_from(body.pose.position.head<2>());
  shown_ = body;
  if (!stroll_.has_path()) stroll_.stay_at(body.pose);
  if (!seat_) return;
  const bool is_commanded = !std::isnan(seat_->at.position.x());
  if (!is_commanded) seat_->at = body.pose;
  if (!std::isnan(seat_->stand.x())) return;
  const Storey* storey = storey_at(step.view.home().storeys, step.feet().z());
  Vec3 under = step.feet();
  if (storey != nullptr) under.z() = storey->elevation;
  seat_->stand = free_place_beside(step.view, under, kBesideSeat).value_or(under);
}

void Person::stand(Outputs& outputs) {
  walker_.stand(outputs);
  progress_.rest();
}

void Person::show(Mode mode, const Step& step) {
  const bool changes = mode != mode_;
  if (changes) step.outputs.event(kModeEvents[static_cast<int>(mode)], "");
  mode_ = mode;
  if (changes || step.renew) shown_ = step.body;
}

Nanoseconds Person::idle_until(const View& view) const {
  const Nanoseconds needed = rests_until(view);
  const Nanoseconds feels = Body::feels_next(view.time());
  return needed <= feels || climates(view).empty() ? needed : feels;
}

Nanoseconds Person::rests_until(const View& view) const {
  if (!walker_.rests() || (seat_ && !settled_)) return 0;
  const auto* wait = std::get_if<Progress::Wait>(&state_);
  if (wait != nullptr && view.time() < wait->away_until) return 0;
  const bool waits = !is<Walks>();
  if (!seat_ && mode_ != Mode::kStanding && !waits) return 0;
  const LinkView body = view.link(link_);
  if (body.pose != shown_.pose || body.linear_velocity != shown_.linear_velocity) {
    return refresh_.next(view.time());
  }
  if (paused_ && !stands_up_) return kForever;
  if (seat_) return rises_at_;
  if (is<StandsAside>()) return view.time() + kScanPeriod;
  if (waits || ride_) return (view.time() / kSecond + 1) * kSecond;
  const Vec2 at = body.pose.position.head<2>();
  if (errand_) {
    const bool stays = errand_->phase() == Errand::Phase::kGaveUp || errand_->stays(at);
    return stays ? kForever : refresh_.next(view.time());
  }
  if ((stroll_.place_in(0) - at).norm() >= kPushedAway) return refresh_.next(view.time());
  const Nanoseconds still = stroll_.still_for();
  return still == kForever ? kForever : view.time() + view.step() + still;
}

void Person::save(SavedParams& params) const {
  params.number("path_time", to_seconds(stroll_.clock()));
  params.flag("stopped", paused_);
  params.flag("closes_doors", doors_.closes());
  gives_.save(params);
  params.unset("stands_at");
  params.text("posture", kPostures[seat_ ? static_cast<int>(seat_->posture) : 0]);
  if (seat_ && started_) {
    const Vec3& at = seat_->stand;
    params.text("stands_at",
                number_text(at.x()) + " " + number_text(at.y()) + " " + number_text(at.z()));
  }
  params.unset("go_to");
  params.unset("push_to");
  params.unset("go_floor");
  if (!errand_) return;
  const Vec2& to = ride_ ? ride_->goal() : errand_->to();
  params.text(errand_->pushes() ? "push_to" : "go_to",
              number_text(to.x()) + " " + number_text(to.y()));
  if (ride_ || floor_) params.number("go_floor", ride_ ? ride_->floor() : *floor_);
}

void Person::skip(Nanoseconds time) {
  if (!paused_ && !seat_ && !errand_ && is<Walks>()) stroll_.advance(time);
}

void Person::report(const View& view, Reading& state) const {
  const LinkView body = started_ ? shown_ : view.link(link_);
  state.set("mode", choice_of(mode_, kModes));
  state.set("x", body.pose.position.x());
  state.set("y", body.pose.position.y());
  state.set("z", body.pose.position.z());
  state.set("yaw", yaw_of(body.pose.rotation));
  state.set("speed", body.linear_velocity.head<2>().norm());
  state.set("going", is_going());
  const bool gave_up = !ride_ && errand_ && errand_->phase() == Errand::Phase::kGaveUp;
  state.set("unreachable", gave_up);
  state.set("why", gave_up ? errand_->why() : std::string());
  const double speed = shown_.linear_velocity.head<2>().norm();
  gives_.report(view, mode_ == Mode::kWalking ? std::optional(speed) : std::nullopt, state);
}

}  // namespace angen::people

// libros_plugin.so
#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/text.h"
#include "devices/doorway.h"
#include "devices/part_names.h"
#include "devices/refresh.h"
#include "devices/servo.h"
#include "plugin/outputs.h"
#include "plugin/registration.h"
#include "plugin/view.h"
#include "plugin/wiring.h"

namespace angen::devices {

namespace {

constexpr char kTopic[] = "/gazebo/Elevator_controller";
constexpr double kArriveError = 0.0005;   // m
constexpr double kNearError = 0.002;      // m
constexpr double kArriveSpeed = 0.002;    // m/s
constexpr double kMaxLag = 0.02;          // m
constexpr double kStallSpeed = 0.005;     // m/s
constexpr Nanoseconds kDwell = kSecond;   // between the doors' opening and their shutting
constexpr double kSlips = 0.1;            // m/s, against its way: its load is another one
constexpr double kOverspeed = 1.15;       // times its greatest velocity: EN 81-20, 5.6.2.2.1
constexpr Nanoseconds kWeighs = kSecond;  // by its brake, on the way
constexpr Nanoseconds kWeighsAgain = 3 * kSecond;  // while it is blocked or lags

// Gains and limits are times the moving mass; the limits exclude the weight.
constexpr PidGains kGains{200.0, 200.0, 25.0, 5.0, -5.0, 5.0, -5.0};
constexpr PidUnits kUnits{"N/m per kg", "N/(m s) per kg", "N s/m per kg", "N/kg"};

// Gains of a plain PID, whose integral carries the weight.
constexpr PidGains kPlainGains{200.0, 200.0, 25.0, 1e4, -1e4, 1e4, -1e4};
constexpr PidUnits kPlainUnits{"N/m", "N/(m s)", "N s/m", "N"};

constexpr double kLevelWithin = 0.005;  // m from a floor, where it is level with it
constexpr double kUnlimited = 1e9;      // m: a joint with a longer travel has no end
constexpr std::size_t kMaxFloors = 1000;
constexpr std::size_t kFewestFloors = 2;

constexpr double kWeighShare = 0.2;        // share of each new weighing, at the rate of publishing
constexpr double kStandardGravity = 9.81;  // m/s^2
constexpr double kGreatestLoad = 2000.0;   // kg, or twice the rated load: more is a blow

// An overload is more than the rated load by 10 %, and by 75 kg at least (EN 81-20, 5.12.1.2).
constexpr double kRatedLoad = 630.0;  // kg, eight persons
constexpr double kOverShare = 0.1;
constexpr double kLeastOver = 75.0;                    // kg
constexpr Nanoseconds kWeighingSettles = kSecond / 2;  // boarding loads drop on the floor

constexpr char kJointDoc[] = "that moves the cabin, where there are several";
constexpr double kUpwards = 0.999;  // z of an axis that points up

bool rises(const ModelInfo::Joint& joint) { return joint.axis.z() > kUpwards; }

const char* const kModes[] = {"IDLE", "UP", "DOWN", "BLOCKED", "OVERLOADED"};
const char* const kModeEvents[] = {"idle", "up", "down", "blocked", "overloaded"};
const char* const kDoorModes[] = {"CLOSED", "OPEN", "OPENING", "CLOSING", "BLOCKED"};
const char* const kDoorEvents[] = {"doors closed", "doors opened", "doors opening", "doors closing",
                                   "doors blocked"};

std::vector<double> read_stops(Params& params) {
  std::vector<double> heights;
  for (const std::vector<double>& stop :
       params.rows("stop", 1, "m",
                   "height of a floor over floor 0, one for each floor from below; "
                   "instead of floor_height and floors")) {
    const bool fits = heights.empty() ? stop.front() == 0.0 : stop.front() > heights.back();
    if (!fits || heights.size() >= kMaxFloors) {
      throw params.error("stop", "the <stop> of floor " + std::to_string(heights.size()) +
                                     (heights.empty() ? " must be 0"
                                                      : " must be above the one before it; at "
                                                        "most 1000 are served"));
    }
    heights.push_back(stop.front());
  }
  return heights;
}

/// Heights of its floors over floor 0, in m, from below: each <stop>; or <floors> of them each
/// <floor_height>; or the storeys of the world within the travel of its joint; or else evenly
/// over that. Throws Error if neither is known.
std::vector<double> read_floors(Params& params, const Wiring& wiring, const JointLimits& limits,
                                const std::string& joint) {
  const double apart = params.number("floor_height", 0.0, "m",
                                     "from one floor to the next; 0: by the storeys of the world, "
                                     "or else evenly over the joint's travel",
                                     kNotNegative);
  const auto given = static_cast<std::size_t>(params.integer(
      "floors", 0, "", "number of floors; 0: the storeys within the joint's travel, or else 2",
      {0, static_cast<int>(kMaxFloors)}));
  std::vector<double> heights = read_stops(params);
  if (!heights.empty()) return heights;
  const std::size_t count = given > 0 ? given : kFewestFloors;
  const auto spread = [&](double height) {
    for (std::size_t floor = 0; floor < count; ++floor) {
      heights.push_back(static_cast<double>(floor) * height);
    }
    return heights;
  };
  if (apart > 0.0 || count == 1) return spread(apart);
  const bool ends = limits.lower < limits.upper && limits.upper < kUnlimited;
  for (const double floor : wiring.floors()) {
    const bool reached = !ends || floor <= limits.upper + kLevelWithin;
    if (reached && (given == 0 || heights.size() < given)) heights.push_back(floor);
  }
  if (heights.size() >= count) return heights;
  heights.clear();
  if (ends) return spread(limits.upper / static_cast<double>(count - 1));
  throw params.error("floor_height", "the world has no " + std::to_string(count) +
                                         " storeys, and the joint " + joint +
                                         " no end; give a <floor_height>, or a <stop> of each "
                                         "floor");
}

/// Weighs the load, by the force on the brake, and finds an overload.
class Weighing {
 public:
  void configure(Params& params) {
    rated_load_ = params.number("rated_load", kRatedLoad, "kg",
                                "it stays, with open doors, under more than this by 10 % (by 75 kg "
                                "at least)",
                                kPositive);
  }
  /// kg, of the cabin with its doors.
  void set_own_mass(double mass) { own_mass_ = mass_ = mass; }

  double mass() const { return mass_; }  // kg, of the cabin with its load
  double load() const { return std::max(0.0, mass_ - own_mass_); }  // kg
  bool overloaded() const { return overloaded_; }
  /// More than is allowed, by the last weighing.
  bool is_heavy() const {
    return mass_ - own_mass_ > rated_load_ + std::max(kOverShare * rated_load_, kLeastOver);
  }
  /// The mass that a weighing now gives; the brake carries cabin and load.
  double weigh(const JointView& lift, const View& view) const {
    const double gravity = -view.gravity().z();
    if (gravity <= 0.0) return mass_;
    const double greatest = std::max(kGreatestLoad, 2.0 * rated_load_);
    const double felt = std::clamp(lift.effort / gravity, own_mass_, own_mass_ + greatest);
    return mass_ + kWeighShare * (felt - mass_);
  }
  void take(double mass) { mass_ = mass; }
  /// Each tick: an overload begins and ends after the load has settled.
  void watch(const View& view) {
    if (is_heavy() == overloaded_) load_since_ = view.time();
    if (view.time() - load_since_ >= kWeighingSettles) overloaded_ = is_heavy();
  }
  /// Warns where the joint is too weak for the load in the file.
  void warn_of_effort(Params& params, double effort, const std::string& lift) const {
    const double needed = (own_mass_ + rated_load_) * kStandardGravity;
    if (!params.has("rated_load") || needed <= effort) return;
    params.warn("rated_load", "<rated_load> and cabin weigh " + number_text(needed) +
                                  " N, but the <effort> of joint '" + lift + "' allows " +
                                  number_text(effort) + " N, which is all that lifts them");
  }
  /// "700 kg of 630 kg".
  std::string detail() const {
    return number_text(std::round(load())) + " kg of " + number_text(rated_load_) + " kg";
  }

 private:
  double own_mass_ = 0.0;
  double mass_ = 0.0;
  double rated_load_ = 0.0;  // kg
  bool overloaded_ = false;
  Nanoseconds load_since_ = 0;  // the last time when is_heavy() agreed with that
};

}  // namespace

/// A cabin on a prismatic joint with sliding doors, and a landing door on each floor. It serves
/// stops in the order in which they were called; doors are shut while it moves, open where it is.
/// With an overload it stays, with open doors.
class Elevator : public Device {
 public:
  explicit Elevator(std::string lift) : lift_name_(std::move(lift)) {}
  void configure(Params& params, Wiring& wiring) override;
  Verdict command(const Command& command, const View& view) override;
  void update(const View& view, Outputs& outputs) override;
  void report(const View& view, Reading& state) const override;
  void save(SavedParams& params) const override;
  std::vector<double> stops() const override { return heights_; }
  Nanoseconds idle_until(const View& view) const override;

 private:
  enum class Phase { kStanding, kShutting, kMoving, kWeighing };
  enum class Mode { kIdle, kUp, kDown, kBlocked, kOverloaded };
  struct Shown {
    JointView lift;
    double door_position = 0.0;
  };

  void wire(Params& params, Wiring& wiring);
  void call(int floor);
  void start(const View& view, Outputs& outputs);
  void stand(const View& view, Outputs& outputs);
  void serve_next_stop(const View& view, Outputs& outputs);
  void move(const View& view, Outputs& outputs);
  bool strays(double velocity) const;
  void weigh_on_the_way(const View& view, Outputs& outputs);
  double weigh(const JointView& lift, const View& view) const;
  std::string detail_of(Mode mode) const;
  int floors() const { return static_cast<int>(heights_.size()); }
  double height_of(int floor) const { return heights_[static_cast<std::size_t>(floor)]; }
  int nearest(double position) const;
  int floor_at(double position) const;  // -1 between floors
  void stay_at(int floor, const View& view);
  Mode mode() const;
  void show(const View& view, Outputs& outputs);

  std::string lift_name_;
  JointRef lift_;
  JointLimits limits_;
  std::vector<Doorway::Leaf> cabin_leaves_;
  std::vector<std::vector<Doorway::Leaf>> landing_leaves_;  // by floor
  Servo servo_;
  bool plain_ = false;  // the controller is a plain PID, which lifts the weight too
  Doorway doorway_;
  StateRefresh refresh_;
  std::vector<double> heights_;  // m, of the floors over floor 0
  Weighing weighing_;
  double brake_force_ = 0.0;  // N
  double overspeed_ = 0.0;    // m/s
  double door_force_ = 0.0;   // N

  Phase phase_ = Phase::kStanding;
  std::deque<int> stops_;
  std::size_t queue_size_ = 1;
  bool started_ = false;
  int target_ = 0;             // floor
  bool rises_ = false;         // on the way there
  Nanoseconds ready_at_ = 0;   // when the doors may shut
  Nanoseconds weighs_at_ = 0;  // when it may weigh on the way, or has done so
  Mode shown_mode_ = Mode::kIdle;
  Doorway::Mode shown_door_ = Doorway::Mode::kClosed;
  Shown shown_;
};

void Elevator::configure(Params& params, Wiring& wiring) {
  ServoSettings servo;
  servo.controller = read_controller(params);
  plain_ = servo.controller == Controller::kPid;
  servo.gains =
      plain_ ? read_gains(params, kPlainGains, kPlainUnits) : read_gains(params, kGains, kUnits);
  servo.max_velocity =
      params.number("max_velocity", 1.0, "m/s", "speed of the cabin's setpoint", kPositive);
  servo.max_acceleration = params.number("max_acceleration", 0.5, "m/s^2",
                                         "acceleration of the cabin's setpoint", kPositive);
  servo.max_lag = kMaxLag;
  servo.arrive_error = kArriveError;
  servo.arrive_speed = kArriveSpeed;
  servo.near_error = kNearError;
  servo.stall_speed = kStallSpeed;
  servo_ = Servo(servo);
  overspeed_ = kOverspeed * servo.max_velocity;
  brake_force_ =
      params.number("brake_force", 30000.0, "N", "brake of the cabin at rest", kPositive);
  weighing_.configure(params);
  const double door_speed =
      params.number("door_max_velocity", 0.5, "m/s", "speed of a door leaf", kPositive);
  door_force_ =
      params.number("door_force_max", 100.0, "N", "greatest force of a door leaf", kPositive);
  doorway_ = Doorway(door_speed, door_force_);
  lift_ = wiring.joint(lift_name_);
  limits_ = wiring.limits(lift_);
  heights_ = read_floors(params, wiring, limits_, lift_name_);
  refresh_ = StateRefresh(params.number(
      "update_rate", 50.0, "Hz", "how often its state is published while it moves", kRefreshRate));
  params.choice("topicName", kTopic, {kTopic}, "where commands come from: one topic for all");
  params.text("joint", "", kJointDoc);
  queue_size_ = static_cast<std::size_t>(
      params.integer("queue_size", 1, "",
                     "how many calls may wait; one more replaces the oldest of them", {1, 1000}));
  for (const std::vector<double>& call :
       params.rows("call", 1, "", "floor that it is called to at the start")) {
    const double floor = call.front();
    if (!(floor >= 0.0 && floor < floors()) || floor != std::floor(floor)) {
      throw params.error("call", "a <call> is not the number of a floor; give 0 to " +
                                     std::to_string(floors() - 1));
    }
    stops_.push_back(static_cast<int>(floor));
  }
  wire(params, wiring);
  weighing_.warn_of_effort(params, limits_.effort, lift_name_);
}

void Elevator::wire(Params& params, Wiring& wiring) {
  const double highest = heights_.back();
  if (limits_.lower < limits_.upper && highest > limits_.upper + kLevelWithin) {
    throw params.error("floors", "the highest floor is at " + number_text(highest) +
                                     " m, the joint " + lift_name_ + " ends at " +
                                     number_text(limits_.upper) + " m");
  }
  if (limits_.lower < limits_.upper && limits_.lower > kLevelWithin) {
    throw params.error("joint", "the joint " + lift_name_ + " begins at " +
                                    number_text(limits_.lower) +
                                    " m, floor 0 is at 0 m; give it a <lower> of 0");
  }
  double own_mass = wiring.mass(wiring.link(wiring.child_of(lift_)));
  // A leaf's open position is the limit further from 0.
  const auto add = [&wiring](const std::string& name, int row, std::vector<Doorway::Leaf>& leaves) {
    if (!wiring.has_joint(name)) return false;
    const JointRef joint = wiring.joint(name);
    const JointLimits limits = wiring.limits(joint);
    const double open = limits.upper > -limits.lower ? limits.upper : limits.lower;
    if (open == 0.0 || std::abs(open) > 100.0) return false;
    const LinkRef link = wiring.link(wiring.child_of(joint));
    leaves.push_back({joint, open, link, wiring.center(link), wiring.axis(joint), row});
    return true;
  };
  for (const char* side : {"left", "right"}) {
    if (!add(std::string("cabin_door_") + side, 0, cabin_leaves_)) continue;
    own_mass += wiring.mass(cabin_leaves_.back().link);
  }
  landing_leaves_.resize(heights_.size());
  for (int floor = 0; floor < floors(); ++floor) {
    for (const char* side : {"left", "right"}) {
      add("landing_door_" + std::to_string(floor) + "_" + side, 1,
          landing_leaves_[static_cast<std::size_t>(floor)]);
    }
  }
  weighing_.set_own_mass(own_mass);
}

Verdict Elevator::command(const Command& command, const View&) {
  const int floor = static_cast<int>(command.number);
  if (floor >= floors()) {
    return Verdict::reject("there is no floor " + std::to_string(floor) +
                           ", it serves Floor0 to Floor" + std::to_string(floors() - 1));
  }
  return Verdict::accept([this, floor] { call(floor); });
}

void Elevator::call(int floor) {
  while (stops_.size() >= queue_size_) stops_.pop_front();
  const int last = !stops_.empty() ? stops_.back() : target_;
  const bool waits_for_it = !stops_.empty() || phase_ != Phase::kStanding;
  if (!waits_for_it || last != floor) stops_.push_back(floor);
}

void Elevator::start(const View& view, Outputs& outputs) {
  started_ = true;
  outputs.motor(lift_, 0.0, brake_force_);
  for (const Doorway::Leaf& leaf : cabin_leaves_) Doorway::brake(leaf, door_force_, outputs);
  for (const std::vector<Doorway::Leaf>& leaves : landing_leaves_) {
    for (const Doorway::Leaf& leaf : leaves) Doorway::brake(leaf, door_force_, outputs);
  }
  const double position = view.joint(lift_).position;
  const int floor = floor_at(position);
  target_ = nearest(position);
  stay_at(floor, view);
  shown_ = {view.joint(lift_), doorway_.position(view)};
  shown_mode_ = mode();
  shown_door_ = doorway_.mode();
}

void Elevator::stay_at(int floor, const View& view) {
  std::vector<Doorway::Leaf> leaves = cabin_leaves_;
  if (floor >= 0) {
    const auto& landing = landing_leaves_[static_cast<std::size_t>(floor)];
    leaves.insert(leaves.end(), landing.begin(), landing.end());
  }
  doorway_.select(leaves, view);
  if (floor >= 0 && !leaves.empty()) doorway_.open(view);
}

void Elevator::update(const View& view, Outputs& outputs) {
  if (!started_) start(view, outputs);
  weighing_.watch(view);
  if (phase_ == Phase::kStanding) {
    stand(view, outputs);
  } else if (phase_ == Phase::kShutting) {
    const bool obstacle = doorway_.update(view, outputs);
    if (obstacle || weighing_.overloaded()) {
      // With an obstacle in the door, or an overload, it opens, and the stop is tried again.
      if (obstacle) outputs.event("obstacle", "door");
      stops_.push_front(target_);
      phase_ = Phase::kStanding;
    } else if (!doorway_.moving() && !weighing_.is_heavy()) {
      outputs.motor(lift_, 0.0, 0.0);
      const JointView lift = view.joint(lift_);
      servo_.start(lift.position, lift.velocity);
      rises_ = height_of(target_) > lift.position;
      phase_ = Phase::kMoving;
    }
  }
  if (phase_ == Phase::kWeighing) weigh_on_the_way(view, outputs);
  if (phase_ == Phase::kMoving) move(view, outputs);
  show(view, outputs);
}

void Elevator::stand(const View& view, Outputs& outputs) {
  doorway_.update(view, outputs);
  const bool held_open = weighing_.overloaded() && floor_at(view.joint(lift_).position) >= 0;
  if (held_open) doorway_.open(view);
  if (doorway_.moving() || weighing_.overloaded()) ready_at_ = view.time() + kDwell;
  if (stops_.empty() || view.time() < ready_at_) return;
  serve_next_stop(view, outputs);
}

void Elevator::serve_next_stop(const View& view, Outputs& outputs) {
  target_ = stops_.front();
  stops_.pop_front();
  if (floor_at(view.joint(lift_).position) == target_) {
    outputs.event("arrived", "floor " + std::to_string(target_));
    return;
  }
  doorway_.close(view);
  phase_ = Phase::kShutting;
}

void Elevator::move(const View& view, Outputs& outputs) {
  const JointView lift = view.joint(lift_);
  const double command =
      servo_.update(height_of(target_), lift.position, lift.velocity, to_seconds(view.step()));
  const bool lags = servo_.blocked() || servo_.lagged() > to_seconds(kWeighs);
  if (!plain_ && (strays(lift.velocity) || (lags && view.time() >= weighs_at_))) {
    outputs.motor(lift_, 0.0, brake_force_);
    phase_ = Phase::kWeighing;
    weighs_at_ = view.time() + kWeighs;
    return;
  }
  if (!servo_.arrived()) {
    outputs.force(lift_, plain_ ? command : weighing_.mass() * (command - view.gravity().z()));
    return;
  }
  outputs.motor(lift_, 0.0, brake_force_);
  phase_ = Phase::kStanding;
  stay_at(target_, view);
  outputs.event("arrived", "floor " + std::to_string(target_));
}

// Against its way, or ahead of its setpoint: its load is another one.
bool Elevator::strays(double velocity) const {
  const double way = rises_ ? 1.0 : -1.0;
  return way * velocity < -kSlips || way * velocity > overspeed_ || way * servo_.lag() < -kMaxLag;
}

// Something may have come aboard, or gone, since the doors are shut.
void Elevator::weigh_on_the_way(const View& view, Outputs& outputs) {
  if (view.time() < weighs_at_) return;
  if (weighing_.overloaded()) {
    phase_ = Phase::kStanding;
    stops_.push_front(target_);
    return stay_at(floor_at(view.joint(lift_).position), view);
  }
  outputs.motor(lift_, 0.0, 0.0);
  const JointView lift = view.joint(lift_);
  if (!servo_.blocked()) servo_.start(lift.position, lift.velocity);
  weighs_at_ = view.time() + kWeighsAgain;
  phase_ = Phase::kMoving;
}

double Elevator::weigh(const JointView& lift, const View& view) const {
  return phase_ == Phase::kMoving ? weighing_.mass() : weighing_.weigh(lift, view);
}

Nanoseconds Elevator::idle_until(const View& view) const {
  if (phase_ != Phase::kStanding || !stops_.empty() || doorway_.moving()) return 0;
  const JointView lift = view.joint(lift_);
  const bool unchanged = lift.position == shown_.lift.position &&
                         lift.velocity == shown_.lift.velocity &&
                         doorway_.position(view) == shown_.door_position && mode() == shown_mode_ &&
                         doorway_.mode() == shown_door_ && weigh(lift, view) == weighing_.mass() &&
                         weighing_.is_heavy() == weighing_.overloaded();
  return unchanged ? kForever : refresh_.next(view.time());
}

int Elevator::nearest(double position) const {
  const auto above = std::lower_bound(heights_.begin(), heights_.end(), position);
  const auto floor = static_cast<int>(above - heights_.begin());
  if (floor == 0) return 0;
  if (floor == floors()) return floor - 1;
  return position - height_of(floor - 1) < height_of(floor) - position ? floor - 1 : floor;
}

int Elevator::floor_at(double position) const {
  const int floor = nearest(position);
  return std::abs(position - height_of(floor)) < kLevelWithin ? floor : -1;
}

Elevator::Mode Elevator::mode() const {
  if (phase_ == Phase::kStanding || phase_ == Phase::kShutting) {
    return weighing_.overloaded() ? Mode::kOverloaded : Mode::kIdle;
  }
  if (servo_.blocked()) return Mode::kBlocked;
  return rises_ ? Mode::kUp : Mode::kDown;
}

void Elevator::show(const View& view, Outputs& outputs) {
  bool renew = refresh_.due(view.time(), view.step());
  if (renew) weighing_.take(weigh(view.joint(lift_), view));
  const Mode now = mode();
  if (now != shown_mode_) {
    outputs.event(kModeEvents[static_cast<int>(now)], detail_of(now));
    shown_mode_ = now;
    renew = true;
  }
  if (doorway_.mode() != shown_door_) {
    shown_door_ = doorway_.mode();
    outputs.event(kDoorEvents[static_cast<int>(shown_door_)], "");
    renew = true;
  }
  if (renew) shown_ = {view.joint(lift_), doorway_.position(view)};
}

std::string Elevator::detail_of(Mode mode) const {
  if (mode != Mode::kOverloaded) return "floor " + std::to_string(target_);
  return weighing_.detail();
}

void Elevator::save(SavedParams& params) const {
  params.unset("call");
  if (phase_ != Phase::kStanding) params.row("call", {static_cast<double>(target_)});
  for (const int floor : stops_) params.row("call", {static_cast<double>(floor)});
}

void Elevator::report(const View& view, Reading& state) const {
  const JointView lift = started_ ? shown_.lift : view.joint(lift_);
  state.set("mode", choice_of(shown_mode_, kModes));
  state.set("position", lift.position);
  state.set("velocity", lift.velocity);
  state.set("target", height_of(target_));
  state.set("floor", floor_at(lift.position));
  state.set("target_floor", target_);
  state.set("floors", floors());
  state.set("load", weighing_.load());
  state.set("door_mode", choice_of(shown_door_, kDoorModes));
  state.set("door_position", shown_.door_position);
}

class ElevatorPlugin : public Plugin {
 public:
  ANGEN_DESCRIBED_AS(
      Kind("elevator", "An elevator with doors.")
          .model("elevator")
          .passage(Kind::Passage::kElevator)
          .example("set elevator elevator 1")
          .command_topic(kTopic)
          .counted_verb("Floor", "floor", {0.0, 999.0}, "rides there, after its present target")
          .choice(
              "mode", {std::begin(kModes), std::end(kModes)},
              "of the cabin; BLOCKED: something holds it; OVERLOADED: it stays, with open doors")
          .shown()
          .number("position", "m", "of the cabin above floor 0")
          .shown(2)
          .number("velocity", "m/s", "upwards")
          .number("target", "m", "target position")
          .integer("floor", "", "where it is within 5 mm, otherwise -1")
          .integer("target_floor", "", "target")
          .integer("floors", "", "how many it serves")
          .number("load", "kg", "in the cabin, by the force on its brake")
          .choice("door_mode", {std::begin(kDoorModes), std::end(kDoorModes)},
                  "BLOCKED: an obstacle is between the leaves")
          .number("door_position", "m", "travel of a door's leaf, 0 shut"))
  std::string needs() const override {
    return "a prismatic joint along z, upwards, with limits, whose parent is the world or fixed to "
           "it, or one that <joint> names";
  }
  // `lift`, or the joint that slides up the building.
  std::vector<Mount> mounts(const ModelInfo& model, Params& params) const override {
    const std::string named = params.text("joint", "", kJointDoc);
    const ModelInfo::Joint* lift = model.joint(named.empty() ? "lift" : named);
    if (!named.empty()) {
      if (lift == nullptr) return {};
      if (lift->type != "prismatic") {
        throw params.error("joint", "joint '" + named + "' is " + lift->type +
                                        "; that of an elevator is prismatic");
      }
      if (!rises(*lift)) {
        throw params.error("joint", "the axis of joint '" + named +
                                        "' does not point up, as that of an elevator does: 0 0 1");
      }
    }
    if (lift != nullptr && lift->type == "prismatic" && rises(*lift)) {
      return {{model.name, lift->name}};
    }
    for (const ModelInfo::Joint& joint : model.joints) {
      if (joint.taken || joint.type != "prismatic" || !joint.on_world || !rises(joint)) continue;
      if (joint.upper - joint.lower < kUnlimited) return {{model.name, joint.name}};
    }
    return {};
  }
  std::unique_ptr<Device> make_device() const override { return make_device_on({"", "lift"}); }
  std::unique_ptr<Device> make_device_on(const Mount& mount) const override {
    return std::make_unique<Elevator>(mount.joint);
  }
};

}  // namespace angen::devices

ANGEN_REGISTER_PLUGIN(angen::devices::ElevatorPlugin)

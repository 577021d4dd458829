#include "devices/door.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <utility>

#include "devices/storeys.h"
#include "plugin/register.h"

namespace angen::devices {

namespace {

constexpr double kClosedWithin = 0.01;   // rad
constexpr double kOpenWithin = 0.02;     // rad
constexpr double kArriveError = 0.0015;  // rad
constexpr double kNearError = 0.003;     // rad
constexpr double kArriveSpeed = 0.02;    // rad/s
constexpr double kMaxLag = 0.08;         // rad
constexpr double kStallSpeed = 0.004;    // rad/s

constexpr PidGains kGains{70.0, 200.0, 25.0, 100.0, -100.0, 120.0, -120.0};
constexpr PidUnits kUnits{"N m/rad", "N m/(rad s)", "N m s/rad", "N m"};

const char* const kModeNames[] = {"CLOSED", "OPEN", "OPENING", "CLOSING", "BLOCKED", "AJAR"};
const char* const kModeEvents[] = {"closed", "opened", "opening", "closing", "blocked", "ajar"};

std::string range_text(const JointLimits& limits) {
  std::ostringstream text;
  text << limits.lower << " to " << limits.upper;
  return text.str();
}

}  // namespace

void Door::configure(Params& params, Wiring& wiring) {
  ServoSettings servo;
  servo.gains = read_gains(params, kGains, kUnits);
  servo.max_velocity =
      params.number("max_velocity", 0.6, "rad/s", "speed of the setpoint", kPositive);
  servo.max_acceleration =
      params.number("max_acceleration", 2.0, "rad/s^2", "acceleration of the setpoint", kPositive);
  width_ = params.number("width", 0.0, "m",
                         "from the hinge to the far edge; 0 = from the leaf's mass and moment",
                         kNotNegative);
  height_ = params.number("height", leaf_.height, "m",
                          "of the opening that air flows through; 0 = none does", kNotNegative);
  const double edge_force =
      params.number("edge_force_max", 150.0, "N", "greatest force at the far edge", kPositive);
  open_position_ = params.number("open_position", -1.57, "rad", "where Open goes");
  closed_position_ = params.number("closed_position", 0.0, "rad", "where Close goes");
  brake_torque_ =
      params.number("brake_torque", 20.0, "N m", "brake of a door that stands open", kNotNegative);
  latch_torque_ = params.number("latch_torque", 200.0, "N m", "brake of a shut door", kNotNegative);
  refresh_ = Refresh(params.number(
      "update_rate", 50.0, "Hz", "how often its state is published while it moves", kRefreshRate));
  params.choice("topicName", leaf_.topic, {leaf_.topic},
                "where commands come from: one topic for all");
  params.text("device_name", "", "the name commands use, instead of the model's and its floor");

  hinge_ = wiring.joint(leaf_.joint);
  limits_ = wiring.limits(hinge_);
  for (const auto& [key, angle] : {std::pair<const char*, double>{"open_position", open_position_},
                                   {"closed_position", closed_position_}}) {
    if (limits_.lower < limits_.upper && (angle < limits_.lower || angle > limits_.upper)) {
      throw params.error(
          key, std::string(key) + " is outside the hinge's " + range_text(limits_) + " rad");
    }
  }
  const double target = params.number("target", closed_position_, "rad",
                                      "where it goes at the start; it stays where it is unless "
                                      "this is given");
  if (params.has("target")) {
    if (target < limits_.lower || target > limits_.upper) {
      throw params.error("target", "target is outside the hinge's " + range_text(limits_) + " rad");
    }
    first_target_ = target;
  }
  // A leaf is a slab: its mass and its moment give its width, m w^2 / 3 = I.
  const double mass = wiring.mass(wiring.link(wiring.child_of(hinge_)));
  if (width_ == 0.0) width_ = std::sqrt(3.0 * limits_.inertia / mass);
  torque_max_ = edge_force * width_;
  servo.inertia = limits_.inertia;
  servo.damping = limits_.damping;
  servo.friction = limits_.friction;
  servo.max_lag = kMaxLag;
  servo.arrive_error = kArriveError;
  servo.arrive_speed = kArriveSpeed;
  servo.near_error = kNearError;
  servo.stall_speed = kStallSpeed;
  servo.integrate_standing = true;
  servo_ = Servo(servo);
}

Verdict Door::command(const Command& command, const View& view) {
  double target = command.verb == "Open" ? open_position_ : closed_position_;
  if (command.verb == "Set") {
    target = command.number;
    if (target < limits_.lower || target > limits_.upper) {
      std::ostringstream reason;
      reason << "the angle " << target << " is outside the hinge's " << range_text(limits_)
             << " rad";
      return Verdict::reject(reason.str());
    }
  }
  return Verdict::accept(
      [this, target, position = view.joint(hinge_).position] { go(target, position); });
}

void Door::go(double target, double position) {
  target_ = target;
  opening_ = std::abs(target - closed_position_) > std::abs(position - closed_position_);
  if (resting_ && started_ && std::abs(target - position) < kArriveError) return;
  leaving_ = resting_ || !started_;
}

void Door::update(const View& view, Outputs& outputs) {
  if (!started_) {
    if (first_target_ && !leaving_) go(*first_target_, view.joint(hinge_).position);
    if (!leaving_) target_ = view.joint(hinge_).position;
    mode_ = mode_at_rest(view.joint(hinge_).position);
    rest(view.joint(hinge_), outputs);
    started_ = true;
  }
  const bool renew = refresh_.due(view.time(), view.step());
  if (resting_ && !leaving_) {
    if (!renew) return;
    const JointView hinge = view.joint(hinge_);
    const Mode mode = mode_at_rest(hinge.position);
    // Something moved it: the latch holds a shut door only.
    if ((mode == Mode::kClosed) != (mode_ == Mode::kClosed)) rest(hinge, outputs);
    show(mode, hinge, true, outputs);
    return;
  }
  const JointView hinge = view.joint(hinge_);
  if (leaving_) {
    leaving_ = false;
    resting_ = false;
    outputs.motor(hinge_, 0.0, 0.0);
    servo_.start(hinge.position, hinge.velocity);
  }
  const double torque =
      servo_.update(target_, hinge.position, hinge.velocity, to_seconds(view.step()));
  if (servo_.arrived()) {
    rest(hinge, outputs);
    show(mode_at_rest(hinge.position), hinge, true, outputs);
    return;
  }
  outputs.force(hinge_, std::clamp(torque, -torque_max_, torque_max_));
  const Mode going = opening_ ? Mode::kOpening : Mode::kClosing;
  show(servo_.blocked() ? Mode::kBlocked : going, hinge, renew, outputs);
}

Nanoseconds Door::idle_until(const View& view) const {
  if (!resting_ || leaving_) return 0;
  const JointView hinge = view.joint(hinge_);
  const bool told = hinge.position == shown_.position && hinge.velocity == shown_.velocity &&
                    mode_at_rest(hinge.position) == mode_;
  return told ? kForever : refresh_.next(view.time());
}

void Door::rest(const JointView& hinge, Outputs& outputs) {
  const bool shut = mode_at_rest(hinge.position) == Mode::kClosed;
  outputs.motor(hinge_, 0.0, shut ? latch_torque_ : brake_torque_);
  resting_ = true;
}

Door::Mode Door::mode_at_rest(double position) const {
  if (std::abs(position - closed_position_) < kClosedWithin) return Mode::kClosed;
  if (std::abs(position - open_position_) < kOpenWithin) return Mode::kOpen;
  return Mode::kAjar;
}

void Door::show(Mode mode, const JointView& hinge, bool renew, Outputs& outputs) {
  if (mode != mode_) {
    mode_ = mode;
    outputs.event(kModeEvents[static_cast<int>(mode)], "");
    renew = true;
  }
  if (renew) shown_ = hinge;
}

void Door::save(SavedParams& params) const {
  params.unset("target");
  const bool is_first = !started_ && !leaving_ && first_target_;
  if (is_first) params.number("target", *first_target_);
  if (leaving_ || (started_ && !resting_)) params.number("target", target_);
}

// From the leaf's edge to the jamb, at most all of the opening; none where it is shut.
double Door::free_width(double position) const {
  const double angle = std::abs(position - closed_position_);
  if (angle < kClosedWithin) return 0.0;
  return std::min(width_, 2.0 * width_ * std::sin(0.5 * std::min(angle, M_PI)));
}

void Door::report(const View& view, Reading& state) const {
  const JointView hinge = started_ ? shown_ : view.joint(hinge_);
  state.set("mode", choice_of(started_ ? mode_ : mode_at_rest(hinge.position), kModeNames));
  state.set("position", hinge.position);
  state.set("velocity", hinge.velocity);
  state.set("target", started_ || leaving_ ? target_ : hinge.position);
  if (height_ > 0.0) {
    state.set("gap", free_width(hinge.position));
    state.set("width", width_);
    state.set("height", height_);
  }
}

LeafPlugin::LeafPlugin(const LeafKind& leaf)
    : leaf_(leaf), kind_(leaf.kind, std::string("A ") + leaf.kind + ".") {
  kind_.example(leaf.example)
      .commanded_on(leaf.topic)
      .verb("Open", "goes to its open_position")
      .verb("Close", "goes to its closed_position")
      .verb("Set", "radians", "rad", {}, "goes to this angle of its hinge")
      .choice("mode", {std::begin(kModeNames), std::end(kModeNames)},
              "AJAR: at rest between shut and open; BLOCKED: commanded, but something holds it")
      .shown()
      .number("position", "rad", "of its hinge, 0 shut, negative open")
      .shown(2)
      .number("velocity", "rad/s", "of its hinge")
      .number("target", "rad", "where it goes")
      .number("gap", "m", "free width of the opening")
      .number("width", "m", "of the leaf")
      .number("height", "m", "of the opening");
  for (const char* model : leaf.models) kind_.model(model);
}

bool LeafPlugin::serves(const ModelInfo& model) const {
  const ModelInfo::Joint* hinge = model.joint(leaf_.joint);
  return hinge != nullptr && hinge->type == "revolute" && hinge->parent == "base";
}

std::string LeafPlugin::instance_name(const ModelInfo& model) const {
  return command_name(model.name, kind_.name, model.pose.position.z());
}

}  // namespace angen::devices

ANGEN_REGISTER_PLUGIN(angen::devices::DoorPlugin)
ANGEN_REGISTER_PLUGIN(angen::devices::WindowPlugin)
ANGEN_REGISTER_PLUGIN(angen::devices::CabinetPlugin)

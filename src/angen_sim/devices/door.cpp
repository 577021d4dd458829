// libdoor_world_plugin.so
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/lists.h"
#include "core/text.h"
#include "devices/part_names.h"
#include "devices/refresh.h"
#include "devices/servo.h"
#include "plugin/outputs.h"
#include "plugin/registration.h"
#include "plugin/view.h"
#include "plugin/wiring.h"

namespace angen::devices {

namespace {

constexpr double kOpen = -1.57;          // rad, the usual open_position
constexpr double kRounded = 0.002;       // rad that a command may exceed a limit: 90 degrees do
constexpr double kClosedWithin = 0.01;   // rad
constexpr double kOpenWithin = 0.02;     // rad
constexpr double kArriveError = 0.0015;  // rad
constexpr double kNearError = 0.003;     // rad
constexpr double kArriveSpeed = 0.02;    // rad/s
constexpr double kMaxLag = 0.08;         // rad
constexpr double kStallSpeed = 0.004;    // rad/s
constexpr double kLoadShare = 10.0;      // times i / p, 1/s, in which it finds its load
constexpr double kSwings = 3.5;          // kg m^2, or kg: what is heavier swings with the gains
constexpr double kLongestStep = 0.01;    // s
constexpr double kLongStep = 0.25;       // share of the time in which its damping stops it
constexpr double kHandForce = 60.0;      // N, at the edge
constexpr double kUprightAxis = 0.97;    // |z| of the axis of an upright leaf: 14 deg
constexpr Nanoseconds kHandleTime = 3 * kSecond;

constexpr PidGains kGains{70.0, 200.0, 25.0, 100.0, -100.0, 120.0, -120.0};
constexpr PidUnits kUnits{"N m/rad", "N m/(rad s)", "N m s/rad", "N m"};

const char* const kModeEvents[] = {"closed", "opened", "opening", "closing", "blocked", "ajar"};
constexpr const char* kLeafModes[] = {"CLOSED", "OPEN", "OPENING", "CLOSING", "BLOCKED", "AJAR"};
constexpr char kLeafJointDoc[] = "a leaf's, besides those that are found";
const char* const kOwnJoints[] = {"hinge", "sash", "front"};

// A heavier leaf swings as quickly, and as little, as one of kSwings.
PidGains gains_for(double inertia, PidGains gains) {
  const double heavy = std::max(1.0, inertia / kSwings);
  gains.p *= heavy;
  gains.d *= heavy;
  return gains;
}

std::string range_text(const JointLimits& limits) {
  return text_of(limits.lower, " to ", limits.upper);
}

}  // namespace

/// The name of a door, window or cabinet front, and the joint that its leaf turns on.
struct LeafKind {
  const char* kind;
  Kind::Passage passage;
  const char* joint;  // revolute or prismatic; its parent is the link `base`
  bool any_joint;     // or any about a vertical axis with limits that hangs on the world
  const char* topic;  // where commands come from
  double height;      // m, of the opening, unless its SDF says
  const char* example;
  std::vector<const char*> models;  // models of worlds/models; the first is the default
};

/// A leaf on a revolute or prismatic joint: a PID drives it, a brake holds it, and a latch where it
/// is shut, until it is commanded, its handle is turned, or something breaks it open.
class Door : public Device {
 public:
  Door(const LeafKind& leaf, std::string joint) : leaf_(leaf), joint_(std::move(joint)) {}
  void configure(Params& params, Wiring& wiring) override;
  Verdict command(const Command& command, const View& view) override;
  void update(const View& view, Outputs& outputs) override;
  void report(const View& view, Reading& state) const override;
  void save(SavedParams& params) const override;
  Nanoseconds idle_until(const View& view) const override;
  bool takes_long_steps() const override { return true; }

 private:
  enum class Mode { kClosed, kOpen, kOpening, kClosing, kBlocked, kAjar };

  void wire(Params& params, Wiring& wiring);
  void read_target(Params& params);
  void go(double target, double position, bool by_hand);
  void warn_of_effort(Params& params) const;
  void rest(const JointView& hinge, Outputs& outputs);
  void hold(bool shut, Outputs& outputs);
  void stay(const View& view, bool renew, Outputs& outputs);
  Mode mode_at_rest(double position) const;
  double free_width(double position) const;
  void report_place(const View& view, Reading& state) const;
  void show(Mode mode, const JointView& hinge, bool renew, Outputs& outputs);

  LeafKind leaf_;
  std::string joint_;
  JointRef hinge_;
  LinkRef child_;
  Servo servo_;
  StateRefresh refresh_;
  double open_position_ = 0.0;
  double closed_position_ = 0.0;
  double torque_max_ = 0.0;
  double brake_torque_ = 0.0;
  double latch_torque_ = 0.0;
  JointLimits limits_;
  double width_ = 0.0;          // m
  double height_ = 0.0;         // m
  bool slides_ = false;         // on a prismatic joint: positions are in m, forces in N
  Vec3 center_ = Vec3::Zero();  // m, of the leaf's mass, in its frame
  Vec3 anchor_ = Vec3::Zero();  // m, of the hinge, in the model's frame
  Vec3 axis_ = Vec3::UnitZ();   // unit, in that frame

  bool started_ = false;
  bool resting_ = true;
  bool leaving_ = false;  // a command came: the brake is to be released
  bool opening_ = false;
  bool by_hand_ = false;  // a hand moves it, not its drive
  bool latched_ = false;
  bool unlatches_ = false;              // its handle was turned since the last update
  Nanoseconds handle_until_ = 0;        // the time until which its handle is turned
  std::optional<double> first_target_;  // rad, at the start
  double target_ = 0.0;
  Mode mode_ = Mode::kClosed;
  JointView shown_;
};

void Door::configure(Params& params, Wiring& wiring) {
  ServoSettings servo;
  servo.controller = read_controller(params);
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
  brake_torque_ =
      params.number("brake_torque", 20.0, "N m",
                    "brake of an open door; at most its latch_torque, unless 0", kNotNegative);
  latch_torque_ = params.number("latch_torque", std::numeric_limits<double>::infinity(), "N m",
                                "that breaks the latch of a shut door open; inf: nothing does, "
                                "0: it has no latch",
                                kNotNegative);
  if (latch_torque_ > 0.0) brake_torque_ = std::min(brake_torque_, latch_torque_);
  refresh_ = StateRefresh(params.number(
      "update_rate", 50.0, "Hz", "how often its state is published while it moves", kRefreshRate));
  params.choice("topicName", leaf_.topic, {leaf_.topic},
                "where commands come from: one topic for all");
  if (leaf_.any_joint) params.texts("joint", "", kLeafJointDoc);
  wire(params, wiring);
  warn_of_effort(params);
  // A leaf is a slab: its mass and its moment give its width, m w^2 / 3 = I.
  child_ = wiring.link(wiring.child_of(hinge_));
  center_ = wiring.center(child_);
  anchor_ = wiring.anchor(hinge_);
  axis_ = wiring.axis(hinge_);
  const double mass = wiring.mass(child_);
  slides_ = limits_.inertia == mass;  // about an axis it is in kg m^2
  if (width_ == 0.0 && slides_) width_ = std::abs(open_position_ - closed_position_);
  if (width_ == 0.0) width_ = std::sqrt(3.0 * limits_.inertia / mass);
  const bool is_plain = servo.controller == Controller::kPid;
  const double force_max = slides_ ? edge_force : edge_force * width_;
  torque_max_ = is_plain ? servo.gains.cmd_max - servo.gains.cmd_min : force_max;
  servo.inertia = limits_.inertia;
  servo.damping = limits_.damping;
  servo.friction = limits_.friction;
  servo.max_lag = kMaxLag;
  servo.arrive_error = kArriveError;
  servo.arrive_speed = kArriveSpeed;
  servo.near_error = kNearError;
  servo.stall_speed = kStallSpeed;
  servo.load_rate = servo.gains.p > 0.0 ? kLoadShare * servo.gains.i / servo.gains.p : 0.0;
  if (!is_plain) servo.gains = gains_for(limits_.inertia, servo.gains);
  const double stops_in = limits_.inertia / servo.gains.d;
  if (!is_plain) wiring.leads(hinge_, std::min(kLongestStep, kLongStep * stops_in));
  servo_ = Servo(servo);
}

void Door::warn_of_effort(Params& params) const {
  for (const char* key : {"brake_torque", "cmd_max", "cmd_min"}) {
    if (!params.has(key)) continue;
    const double torque = std::abs(params.number(key, 0.0, "N m", ""));
    if (torque <= limits_.effort) continue;
    params.warn(key, std::string("<") + key + "> requests " + number_text(torque) +
                         " N m, but the <effort> of joint '" + joint_ + "' allows " +
                         number_text(limits_.effort) + " N m, which applies");
  }
}

// A hinge that ends before the usual angles opens as far as it does from where it is shut.
void Door::wire(Params& params, Wiring& wiring) {
  hinge_ = wiring.joint(joint_);
  limits_ = wiring.limits(hinge_);
  const double shut = std::clamp(0.0, limits_.lower, limits_.upper);
  const bool opens_up = limits_.upper - shut > shut - limits_.lower;
  const double far = opens_up ? limits_.upper : limits_.lower;
  const bool usual = limits_.lower >= limits_.upper || limits_.lower <= kOpen;
  open_position_ = params.number("open_position", usual ? kOpen : far, "rad", "target of Open");
  closed_position_ = params.number("closed_position", shut, "rad", "target of Close");
  for (const auto& [key, angle] : {std::pair<const char*, double>{"open_position", open_position_},
                                   {"closed_position", closed_position_}}) {
    if (limits_.lower < limits_.upper && (angle < limits_.lower || angle > limits_.upper)) {
      throw params.error(
          key, std::string(key) + " is outside the hinge's " + range_text(limits_) + " rad");
    }
  }
  read_target(params);
}

// One number is for each leaf of the model; after a joint's name it is for that leaf.
void Door::read_target(Params& params) {
  for (const std::string& text : params.texts("target", "rad",
                                              "target at the start; with several leaves "
                                              "JOINT RADIANS; otherwise it stays where it is")) {
    const std::size_t blank = text.rfind(' ');
    const std::string joint = blank == std::string::npos ? "" : trimmed(text.substr(0, blank));
    if (!joint.empty() && joint != joint_) continue;
    first_target_ = parse_finite(blank == std::string::npos ? text : text.substr(blank + 1));
    if (!first_target_ || *first_target_ < limits_.lower || *first_target_ > limits_.upper) {
      throw params.error("target", "<target> is \"" + text + "\", must be in the hinge's " +
                                       range_text(limits_) + " rad");
    }
  }
}

Verdict Door::command(const Command& command, const View& view) {
  if (command.verb == "Unlatch") {
    return Verdict::accept([this, until = view.time() + kHandleTime] {
      unlatches_ = true;
      handle_until_ = until;
    });
  }
  const bool by_hand = command.verb == "OpenByHand" || command.verb == "CloseByHand";
  const bool opens = command.verb == "Open" || command.verb == "OpenByHand";
  double target = opens ? open_position_ : closed_position_;
  if (command.verb == "Set") {
    target = command.number;
    if (target < limits_.lower - kRounded || target > limits_.upper + kRounded) {
      return Verdict::reject(
          text_of("the angle ", target, " is outside the hinge's ", range_text(limits_), " rad"));
    }
    target = std::clamp(target, limits_.lower, limits_.upper);
  }
  return Verdict::accept([this, target, by_hand, position = view.joint(hinge_).position] {
    go(target, position, by_hand);
  });
}

void Door::go(double target, double position, bool by_hand) {
  target_ = target;
  by_hand_ = by_hand;
  opening_ = std::abs(target - closed_position_) > std::abs(position - closed_position_);
  if (resting_ && started_ && std::abs(target - position) < kArriveError) return;
  leaving_ = resting_ || !started_;
}

void Door::update(const View& view, Outputs& outputs) {
  if (!started_) {
    if (first_target_ && !leaving_) go(*first_target_, view.joint(hinge_).position, false);
    if (!leaving_) target_ = view.joint(hinge_).position;
    mode_ = mode_at_rest(view.joint(hinge_).position);
    rest(view.joint(hinge_), outputs);
    started_ = true;
  }
  const bool renew = refresh_.due(view.time(), view.step());
  if (std::exchange(unlatches_, false)) outputs.event("unlatched", "");
  if (resting_ && !leaving_) {
    stay(view, renew, outputs);
    return;
  }
  const JointView hinge = view.joint(hinge_);
  if (leaving_) {
    leaving_ = false;
    resting_ = false;
    hold(false, outputs);
    outputs.motor(hinge_, 0.0, 0.0);
    // A load in its direction may have ended: the servo notices that once the leaf moves.
    const bool against = hinge.effort * (target_ - hinge.position) > 0.0;
    servo_.start(hinge.position, hinge.velocity, against ? -hinge.effort : 0.0);
  }
  const double most = by_hand_ ? kHandForce * width_ : torque_max_;
  const double torque =
      servo_.update(target_, hinge.position, hinge.velocity, to_seconds(view.step()), most);
  if (servo_.arrived() || (by_hand_ && servo_.blocked())) {  // a hand gives up
    if (!servo_.arrived()) show(Mode::kBlocked, hinge, true, outputs);
    rest(hinge, outputs);
    show(mode_at_rest(hinge.position), hinge, true, outputs);
    return;
  }
  outputs.force(hinge_, std::clamp(torque, -most, most));
  const Mode going = opening_ ? Mode::kOpening : Mode::kClosing;
  show(servo_.blocked() ? Mode::kBlocked : going, hinge, renew, outputs);
}

Nanoseconds Door::idle_until(const View& view) const {
  if (!resting_ || leaving_ || unlatches_) return 0;
  const JointView hinge = view.joint(hinge_);
  // The latch must not miss a leaf that passes by.
  if (!latched_ && latch_torque_ > 0.0 && hinge.velocity != 0.0) return 0;
  const bool up_to_date = hinge.position == shown_.position && hinge.velocity == shown_.velocity &&
                          mode_at_rest(hinge.position) == mode_;
  const Nanoseconds next = up_to_date ? kForever : refresh_.next(view.time());
  return view.time() < handle_until_ ? std::min(next, handle_until_) : next;
}

// Something may move it: the latch catches it where it is shut, and releases it where it has
// broken.
void Door::stay(const View& view, bool renew, Outputs& outputs) {
  const JointView hinge = view.joint(hinge_);
  const Mode mode = mode_at_rest(hinge.position);
  hold(mode == Mode::kClosed && view.time() >= handle_until_, outputs);
  if (renew) show(mode, hinge, true, outputs);
}

void Door::rest(const JointView& hinge, Outputs& outputs) {
  outputs.motor(hinge_, 0.0, brake_torque_ + std::abs(servo_.load()));  // besides its load
  hold(mode_at_rest(hinge.position) == Mode::kClosed, outputs);
  resting_ = true;
}

void Door::hold(bool shut, Outputs& outputs) {
  const bool latches = shut && latch_torque_ > 0.0;
  if (latches == latched_) return;
  latched_ = latches;
  if (latches) {
    outputs.latch(hinge_, latch_torque_);
  } else {
    outputs.unlatch(hinge_);
  }
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
  const auto write = [&](double target) {
    const std::string joint = joint_ == leaf_.joint ? "" : joint_ + " ";
    params.text("target", joint + number_text(target));
  };
  const bool is_first = !started_ && !leaving_ && first_target_;
  if (is_first) write(*first_target_);
  if (leaving_ || (started_ && !resting_)) write(target_);
}

// From the leaf's edge to the jamb, at most all of the opening; none if it is shut.
double Door::free_width(double position) const {
  const double angle = std::abs(position - closed_position_);
  if (angle < kClosedWithin) return 0.0;
  if (slides_) return std::min(width_, angle);
  return std::min(width_, 2.0 * width_ * std::sin(0.5 * std::min(angle, M_PI)));
}

// The leaf's direction is that from the hinge to its middle.
void Door::report_place(const View& view, Reading& state) const {
  const Pose model = view.pose();
  const Vec3 hinge = model * anchor_;
  const double up = (model.rotation * axis_).z();
  if (std::abs(up) < kUprightAxis) return;
  const Vec3 leaf = view.link(child_).pose * center_ - hinge;
  const double turned = std::copysign(1.0, up) * (view.joint(hinge_).position - closed_position_);
  state.set("hinge", std::vector<double>{hinge.x(), hinge.y(), hinge.z()});
  state.set("shut", std::remainder(std::atan2(leaf.y(), leaf.x()) - turned, 2.0 * M_PI));
  state.set("opens", std::copysign(1.0, up) * (open_position_ - closed_position_));
}

void Door::report(const View& view, Reading& state) const {
  const JointView hinge = started_ ? shown_ : view.joint(hinge_);
  state.set("mode", choice_of(started_ ? mode_ : mode_at_rest(hinge.position), kLeafModes));
  state.set("position", hinge.position);
  state.set("velocity", hinge.velocity);
  state.set("target", started_ || leaving_ ? target_ : hinge.position);
  if (height_ > 0.0) {
    state.set("gap", free_width(hinge.position));
    state.set("width", width_);
    state.set("height", height_);
    report_place(view, state);
  }
}

namespace {

bool limited(double lower, double upper) { return lower < upper && upper - lower < 2.0 * M_PI; }

bool turns_or_slides(const ModelInfo::Joint& joint) {
  return joint.type == "revolute" || joint.type == "prismatic";
}

// A leaf on a frame that is fixed to the world and named as a door, window or cabinet: an arm's
// first joint may turn as a door does.
bool is_framed(const ModelInfo::Joint& joint, const ModelInfo& model, const LeafKind& leaf) {
  if (!leaf.any_joint || joint.type != "revolute" || !joint.on_world || !joint.vertical()) {
    return false;
  }
  const bool is_own = is_in(joint.name, kOwnJoints);
  if (is_own || !limited(joint.lower, joint.upper)) return false;
  for (const std::string& name : {joint.name, joint.child, model.name}) {
    if (name.find(leaf.kind) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

class LeafPlugin : public Plugin {
 public:
  explicit LeafPlugin(const LeafKind& leaf);
  const Kind& kind() const override { return kind_; }
  std::string needs() const override;
  std::vector<Mount> mounts(const ModelInfo& model, Params& params) const override;
  std::unique_ptr<Device> make_device() const override { return make_device_on({"", leaf_.joint}); }
  std::unique_ptr<Device> make_device_on(const Mount& mount) const override {
    return std::make_unique<Door>(leaf_, mount.joint);
  }

 private:
  bool is_leaf(const ModelInfo::Joint& joint) const;
  std::vector<const ModelInfo::Joint*> leaves(const ModelInfo& model, Params& params) const;
  std::string name_of(const ModelInfo::Joint& leaf, const ModelInfo& model, bool only) const;

  LeafKind leaf_;
  Kind kind_;
};

struct DoorPlugin : LeafPlugin {
  DoorPlugin()
      : LeafPlugin({"door",
                    Kind::Passage::kDoor,
                    "hinge",
                    true,
                    "/gazebo/Door_controller",
                    2.1,
                    "set door kitchen0 open",
                    {"kitchen_door", "bathroom_door", "bedroom_door", "entrance_door",
                     "livingroom_door", "workroom_door"}}) {}
};

struct WindowPlugin : LeafPlugin {
  WindowPlugin()
      : LeafPlugin({"window",
                    Kind::Passage::kWindow,
                    "sash",
                    false,
                    "/gazebo/Window_controller",
                    1.2,
                    "set window window0 open",
                    {"window"}}) {}
};

struct CabinetPlugin : LeafPlugin {
  CabinetPlugin()
      : LeafPlugin({"cabinet",
                    Kind::Passage::kNone,
                    "front",
                    false,
                    "/gazebo/Cabinet_controller",
                    0.0,
                    "set cabinet wall0 open",
                    {"wall_cabinet"}}) {}
};

LeafPlugin::LeafPlugin(const LeafKind& leaf)
    : leaf_(leaf), kind_(leaf.kind, std::string("A ") + leaf.kind + ".") {
  kind_.passage(leaf.passage)
      .example(leaf.example)
      .command_topic(leaf.topic)
      .verb("Open", "moves to its open_position")
      .verb("Close", "moves to its closed_position")
      .verb("OpenByHand", "a hand turns its handle and opens it, with at most 60 N at its edge")
      .verb("CloseByHand", "a hand shuts it, with at most 60 N at its edge")
      .verb("Unlatch", "turns its handle: for 3 s its latch does not hold")
      .verb("Set", "radians", "rad", {}, "moves to this angle of its hinge")
      .choice("mode", {std::begin(kLeafModes), std::end(kLeafModes)},
              "AJAR: at rest between shut and open; BLOCKED: commanded, but something holds it")
      .shown()
      .number("position", "rad", "of its hinge, 0 shut, negative open")
      .shown(2)
      .number("velocity", "rad/s", "of its hinge")
      .number("target", "rad", "target angle")
      .number("gap", "m", "free width of the opening")
      .number("width", "m", "of the leaf")
      .number("height", "m", "of the opening")
      .numbers("hinge", "m", "where its hinge is, in the world")
      .number("shut", "rad", "direction from the hinge to the edge of the shut leaf, in the world")
      .number("opens", "rad", "from shut to open, counterclockwise from above");
  for (const char* model : leaf.models) kind_.model(model);
}

std::string LeafPlugin::needs() const {
  std::string needed = std::string("a revolute joint ") + leaf_.joint + " with parent base";
  if (leaf_.any_joint) {
    needed +=
        ", one about a vertical axis with limits whose parent is the world, or fixed to it where "
        "a name says door, or one that <joint> names";
  }
  return needed;
}

bool LeafPlugin::is_leaf(const ModelInfo::Joint& joint) const {
  if (joint.name == leaf_.joint && joint.parent == "base") return turns_or_slides(joint);
  if (joint.type != "revolute") return false;
  const bool is_others = joint.name != leaf_.joint && is_in(joint.name, kOwnJoints);
  return leaf_.any_joint && !is_others && joint.parent == "world" && joint.on_world &&
         joint.vertical() && limited(joint.lower, joint.upper);
}

std::vector<const ModelInfo::Joint*> LeafPlugin::leaves(const ModelInfo& model,
                                                        Params& params) const {
  std::vector<std::string> named;
  if (leaf_.any_joint) named = params.texts("joint", "", kLeafJointDoc);
  std::vector<const ModelInfo::Joint*> found;
  for (const ModelInfo::Joint& joint : model.joints) {
    const bool is_named = is_in(joint.name, named);
    if (is_named && !turns_or_slides(joint)) {
      throw params.error("joint", "joint '" + joint.name + "' is " + joint.type +
                                      "; that of a leaf is revolute or prismatic");
    }
    const bool is_found = is_leaf(joint) || is_framed(joint, model, leaf_);
    if ((is_named || is_found) && !joint.taken) found.push_back(&joint);
  }
  return found;
}

std::vector<Mount> LeafPlugin::mounts(const ModelInfo& model, Params& params) const {
  const std::vector<const ModelInfo::Joint*> found = leaves(model, params);
  std::vector<Mount> mounts;
  mounts.reserve(found.size());
  for (const ModelInfo::Joint* leaf : found) {
    mounts.push_back({name_of(*leaf, model, found.size() == 1), leaf->name});
  }
  return mounts;
}

// The model's only leaf is named after it, if its name has the kind; others after their links.
std::string LeafPlugin::name_of(const ModelInfo::Joint& leaf, const ModelInfo& model,
                                bool only) const {
  std::string of_model = command_name(model, kind_.name);
  const bool is_own = leaf.name == leaf_.joint && leaf.parent == "base";
  if (only && (is_own || model.name.find(kind_.name) != std::string::npos)) return of_model;
  for (const std::string& part : {leaf.child, leaf.name}) {
    std::string name = leaf_name(part, kind_.name, floor_at(model.storeys, leaf.height));
    if (!name.empty()) return name;
  }
  return only ? of_model : leaf.name;
}

}  // namespace angen::devices

ANGEN_REGISTER_PLUGIN(angen::devices::DoorPlugin)
ANGEN_REGISTER_PLUGIN(angen::devices::WindowPlugin)
ANGEN_REGISTER_PLUGIN(angen::devices::CabinetPlugin)

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "devices/refresh.h"
#include "devices/servo.h"
#include "plugin/plugin.h"
#include "plugin/wiring.h"

namespace angen::devices {

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

inline constexpr const char* kLeafModes[] = {"CLOSED",  "OPEN",    "OPENING",
                                             "CLOSING", "BLOCKED", "AJAR"};
inline constexpr char kLeafJointDoc[] = "a leaf's, besides those that are found";

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

class DoorPlugin : public LeafPlugin {
 public:
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

class WindowPlugin : public LeafPlugin {
 public:
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

class CabinetPlugin : public LeafPlugin {
 public:
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

}  // namespace angen::devices

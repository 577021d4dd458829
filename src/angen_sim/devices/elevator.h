#pragma once

#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "devices/doorway.h"
#include "devices/part_names.h"
#include "devices/refresh.h"
#include "devices/servo.h"
#include "devices/weighing.h"
#include "plugin/plugin.h"
#include "plugin/wiring.h"

namespace angen::devices {

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

class ElevatorPlugin : public Plugin {
 public:
  const Kind& kind() const override;
  std::string needs() const override;
  std::vector<Mount> mounts(const ModelInfo& model, Params& params) const override;
  std::unique_ptr<Device> make_device() const override { return make_device_on({"", "lift"}); }
  std::unique_ptr<Device> make_device_on(const Mount& mount) const override {
    return std::make_unique<Elevator>(mount.joint);
  }
};

}  // namespace angen::devices

#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "devices/refresh.h"
#include "people/body.h"
#include "people/door_use.h"
#include "people/errand.h"
#include "people/modes.h"
#include "people/navigator.h"
#include "people/places.h"
#include "people/progress.h"
#include "people/ride.h"
#include "people/seat.h"
#include "people/stroll.h"
#include "people/walker.h"
#include "plugin/plugin.h"

namespace angen::people {

/// Walks a path, or to a goal, by a motor of limited force. It plans its way to a goal on a map of
/// things that cannot move, opens doors by hand, and walks round obstacles that it sees. If it
/// cannot come on it steps back, so that a door can open towards it, and waits; a goal that it
/// cannot reach it gives up. It pushes only when commanded to.
class Person : public Device {
 public:
  explicit Person(std::shared_ptr<StoreyMaps> maps = std::make_shared<StoreyMaps>())
      : maps_(std::move(maps)) {}
  void configure(Params& params, Wiring& wiring) override;
  Verdict command(const Command& command, const View& view) override;
  void update(const View& view, Outputs& outputs) override;
  void report(const View& view, Reading& state) const override;
  Nanoseconds idle_until(const View& view) const override;
  void skip(Nanoseconds time) override;
  void save(SavedParams& params) const override;
  bool takes_long_steps() const override { return true; }
  void pose_limbs(std::vector<Pose>& limbs) const override { gives_.pose_limbs(limbs); }

 private:
  using Vec2 = Surroundings::Vec2;
  using Look = Walker::Look;

  struct Walks {};
  struct WaitsAtDoor {};  // until another opens it
  struct StandsAside {    // until others have come out of a narrow passage
    Vec2 place;           // m
    Nanoseconds since = 0;
    Nanoseconds walks_until = 0;
  };
  using State = std::variant<Walks, WaitsAtDoor, StandsAside, Progress::Wait>;

  /// What a step needs to know and to do.
  struct Step {
    const View& view;
    LinkView body;
    Outputs& outputs;
    bool renew;  // the state that others see

    const Vec3& feet() const { return body.pose.position; }
    Vec2 at() const { return body.pose.position.head<2>(); }
    Nanoseconds now() const;
  };

  template <typename T>
  bool is() const {
    return std::holds_alternative<T>(state_);
  }
  void start(const Step& step);
  void start_anew();
  void behave();
  Nanoseconds rests_until(const View& view) const;

  // Along its path.
  void stroll(const Path::Place& place, const Step& step);
  void walk_path(const Path::Place& place, const Step& step);
  void go_round(const Step& step);
  void find_rejoin(const Step& step);

  // To another floor.
  void begin_ride(const Step& step);
  bool follow_ride(const Step& step);

  // Sitting and lying.
  Verdict command_posture(const Command& command, const View& view);
  Pose stands_at(const View& view) const;
  bool sits(const Step& step);
  void rise(const Step& step);

  // Where it was sent.
  void walk_to(const Vec2& to, bool pushes);
  void run_errand(const Step& step);
  bool plan(const Step& step, bool with_seen);
  bool finds_new_way(const Step& step);
  void begin_new_way(const Vec2& at);
  void arrive(Outputs& outputs);
  void give_up(std::string why, Outputs& outputs);
  std::string why_no_way(const Step& step) const;
  std::string what_holds(const Step& step) const;
  bool is_going() const;
  std::optional<double> way_to_leaf(const Step& step) const;
  bool is_held_at_leaf(const Step& step) const;
  bool explore(const Step& step);
  void take_other_way(const Step& step);

  // Where something holds it.
  bool uses_door(const std::vector<Vec2>& places, const Step& step);
  bool gives_way(const Step& step);
  bool stands_aside(Look look, const Step& step);
  void make_room(const Step& step);
  void wait(const Step& step);
  bool makes_for_leaf(const Step& step);
  bool shuts_leaf(const Step& step);
  bool is_freed(const Progress::Wait& wait, const Step& step);
  void hold(const Vec2& at);
  void note(const Progress::Step& progress, const Step& step);

  void stand(Outputs& outputs);
  void show(Mode mode, const Step& step);

  std::shared_ptr<StoreyMaps> maps_;
  LinkRef link_;
  devices::StateRefresh refresh_;
  Body gives_;
  Walker walker_;
  DoorUse doors_;
  Navigator navigator_;
  Progress progress_;
  State state_ = Walks{};
  Stroll stroll_;
  std::optional<Errand> errand_;  // instead of its path
  std::optional<Ride> ride_;      // the errand is a part of it
  std::optional<int> floor_;      // the floor of an errand that has not begun
  std::optional<Seat> seat_;      // while it sits or lies
  bool settled_ = false;          // its body has taken the posture
  bool stands_up_ = false;        // after Stand
  Nanoseconds rises_at_ = 0;      // when it tries to get up next
  int rise_tries_ = 0;
  double speed_ = 1.0;  // m/s, on an errand
  bool avoids_ = true;
  bool paused_ = false;
  bool started_ = false;
  bool can_sit_ = false;  // its body has the postures
  Mode mode_ = Mode::kStanding;
  LinkView shown_;
};

class PersonPlugin : public Plugin {
 public:
  const Kind& kind() const override;
  bool serves(const ModelInfo& model) const override;
  std::unique_ptr<Device> make_device() const override { return std::make_unique<Person>(maps_); }

 private:
  std::shared_ptr<StoreyMaps> maps_ = std::make_shared<StoreyMaps>();
};

}  // namespace angen::people

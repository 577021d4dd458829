#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devices/braking.h"
#include "devices/door_use.h"
#include "devices/gait.h"
#include "devices/path.h"
#include "devices/refresh.h"
#include "devices/route.h"
#include "devices/surroundings.h"
#include "plugin/plugin.h"

namespace angen::devices {

inline constexpr const char* kPersonModes[] = {"STANDING", "WALKING", "BLOCKED"};

/// Walks a path, or to a goal, by a motor of limited force. It plans its way to a goal on a map of
/// things that cannot move, opens doors by hand, and walks round obstacles that it sees. Where it
/// cannot come on it steps back, so that a door can open towards it, and waits; a goal that it
/// cannot reach it gives up. It pushes only when commanded to.
class Person : public Device {
 public:
  void configure(Params& params, Wiring& wiring) override;
  Verdict command(const Command& command, const View& view) override;
  void update(const View& view, Outputs& outputs) override;
  void report(const View& view, Reading& state) const override;
  Nanoseconds idle_until(const View& view) const override;
  void skip(Nanoseconds time) override;
  void save(SavedParams& params) const override;
  bool takes_long_steps() const override { return true; }
  void pose_limbs(std::vector<Pose>& limbs) const override;

 private:
  using Vec2 = Surroundings::Vec2;

  static constexpr double kReturnSpeed = 0.8;  // m/s, back to a path it was pushed off
  static constexpr double kPushedAway = 0.1;   // m: further than this it walks back
  static constexpr double kProgress = 0.05;    // m: less than this in a second is none
  static constexpr Nanoseconds kPathAhead =
      7 * kSecond / 5;  // time on its path, checked for obstacles

  enum class Mode { kStanding, kWalking, kBlocked };
  enum class Scan { kNone, kScanned, kPlans };

  static Path read_path(Params& params);
  void start(const LinkView& body);
  void start_anew();
  void feel_air(const View& view, Outputs& outputs);
  double activity() const;
  Nanoseconds rests_until(const View& view) const;
  void walk(const Path::Place& place, const View& view, bool renew, Outputs& outputs);
  void go(const View& view, bool renew, Outputs& outputs);
  bool plan(const View& view, const LinkView& body, bool with_seen);
  FloorMap map_of_storey(const View& view, const Vec3& feet);
  double way_left(const Vec2& at) const;
  void give_up(Outputs& outputs);
  bool uses_door(const LinkView& body, const View& view, const Vec2& to, bool looks, bool renew,
                 Outputs& outputs);
  void take_other_way(const LinkView& body, const View& view, Outputs& outputs);
  void learn(const View& view, const Vec3& feet);
  void explore(const View& view, const LinkView& body);
  void note_obstacle(const View& view, const LinkView& body);
  void wait(const LinkView& body, const View& view);
  void note_held(const Vec2& at);
  bool gives_way(const LinkView& body, const View& view, bool renew, Outputs& outputs);
  bool must_give_up(Nanoseconds now) const;
  bool lingers(const Vec2& at, Nanoseconds now);
  bool is_freed(const LinkView& body, const View& view);
  void go_round(const LinkView& body, const View& view, bool renew, Outputs& outputs);
  Scan scan_surroundings(const LinkView& body, const View& view);
  void find_rejoin(const LinkView& body, const View& view);
  std::optional<Vec2> way_for(const LinkView& body, const View& view, const Vec2& to) const;
  std::optional<Vec2> way_past(const LinkView& body, const View& view, const Vec2& to) const;
  Vec2 steer(const LinkView& body, const Vec2& to, double fastest);
  double slowed(const Vec2& at, const Vec2& direction, double speed);
  void head_for(const Vec2& velocity, double turn, Outputs& outputs);
  static double turn_to(const Vec2& direction, const LinkView& body);
  void make_room(const LinkView& body, const View& view);
  double nearer_by(const Vec2& at, const Vec2& goal) const;
  void note_progress(const Vec2& at, bool nearer, bool on_path, const View& view);
  void stand(Outputs& outputs);
  double sound() const;
  void show(Mode mode, const LinkView& body, bool renew, Outputs& outputs);

  LinkRef body_;
  Gait gait_;
  Path path_;
  StateRefresh refresh_;
  double skin_ = 0.0;      // K
  double clothing_ = 0.0;  // K
  bool skin_follows_ = true;
  bool clothing_follows_ = true;
  double air_ = 0.0;          // K, around it, which they follow
  double humidity_ = 50.0;    // percent, of that
  Nanoseconds felt_at_ = -1;  // time of the last air, as a multiple of a period
  std::vector<SurfaceRef> surfaces_;
  double force_max_ = 0.0;       // N
  double surface_ = 1.0;         // its body, as a share of a person's
  double step_sound_ = 0.0;      // dB over 1 pW
  double speech_sound_ = 0.0;    // dB over 1 pW
  Nanoseconds clock_ = 0;        // time on the path; below 0 while the start is delayed
  Nanoseconds stalled_ = 0;      // since it last came on
  Vec2 came_to_ = Vec2::Zero();  // where that was
  bool held_ = false;            // something holds it, until it has come on
  Nanoseconds best_at_ = 0;      // when it last was nearer to its goal than ever
  Nanoseconds resumed_at_ = 0;   // when it last went on after waiting
  Nanoseconds held_clock_ = 0;   // clock_ then
  double held_left_ = 0.0;       // m of the way to its goal then
  int tries_ = 0;                // while it is held
  int errors_ = 0;               // tries on a free way that was none
  bool waits_at_door_ = false;   // until another opens it
  bool waits_ = false;           // until it sees a free way
  Nanoseconds waits_since_ = 0;  // time at which waits_ began
  Vec2 circle_ = Vec2::Zero();   // middle of the one that it is in
  Nanoseconds entered_at_ = 0;   // when it came into the circle
  Nanoseconds away_until_ = 0;   // end of stepping back
  Vec2 back_to_ = Vec2::Zero();  // where it does so
  Nanoseconds retry_at_ = 0;     // if it sees a free way
  Nanoseconds blind_at_ = 0;     // in any case
  Nanoseconds checked_at_ = -1;  // time of the last check, in whole seconds
  bool opens_doors_ = true;
  DoorUse doors_;
  struct Order {
    Vec2 to;  // m, world
    bool pushes = false;
    bool arrived = false;
    bool planned = false;
    bool unreachable = false;           // it has given up
    double stays_within = kPushedAway;  // m of the goal, once it has arrived
  };
  std::optional<Order> order_;       // instead of its path
  std::optional<Route> route_;       // to its goal; none: straight
  std::optional<FloorMap> storey_;   // the last one
  std::vector<Vec2> seen_;           // obstacles that have held it on the way there
  std::vector<std::string> failed_;  // doors that did not open, on the way there
  std::optional<Vec2> target_;       // on that
  Nanoseconds came_clock_ = 0;       // on its path: its maximum
  double came_left_ = std::numeric_limits<double>::infinity();  // m of the way, its minimum
  double late_ = 0.0;   // s, of its speed in longer steps: on average it is that old
  double speed_ = 1.0;  // m/s, on an order
  bool avoids_ = true;
  Surroundings surroundings_;
  Nanoseconds scanned_at_ = -1;        // last scan, as a multiple of kScanPeriod
  Braking braking_;                    // before obstacles
  std::optional<Nanoseconds> rejoin_;  // time on the path where it comes back to it
  std::optional<Vec2> aim_;            // first place of a way round
  bool speaks_ = false;
  bool spoke_ = false;  // at the last update
  bool paused_ = false;
  bool resting_ = false;
  bool started_ = false;
  Mode mode_ = Mode::kStanding;
  LinkView shown_;
};

class PersonPlugin : public Plugin {
 public:
  const Kind& kind() const override;
  bool serves(const ModelInfo& model) const override;
  std::unique_ptr<Device> make_device() const override { return std::make_unique<Person>(); }
};

}  // namespace angen::devices

#pragma once

#include <memory>
#include <optional>
#include <string>

#include "devices/braking.h"
#include "devices/path.h"
#include "devices/refresh.h"
#include "devices/surroundings.h"
#include "plugin/plugin.h"

namespace angen::devices {

inline constexpr const char* kPersonModes[] = {"STANDING", "WALKING", "BLOCKED"};

/// Walks a path, or to a goal, by a motor of limited force. It walks round obstacles that it sees
/// in its way, or stops before it; its path waits then, and it steps back from time to time, so
/// that a door can open towards it. It pushes only where it is told to.
class Person : public Device {
 public:
  void configure(Params& params, Wiring& wiring) override;
  Verdict command(const Command& command, const View& view) override;
  void update(const View& view, Outputs& outputs) override;
  void report(const View& view, Reading& state) const override;
  Nanoseconds idle_until(const View& view) const override;
  void skip(Nanoseconds time) override;
  void save(SavedParams& params) const override;

 private:
  using Vec2 = Surroundings::Vec2;
  enum class Mode { kStanding, kWalking, kBlocked };
  enum class Scan { kNone, kScanned, kPlans };

  static Path read_path(Params& params);
  void start(const LinkView& body);
  void walk(const Path::Place& place, const View& view, bool renew, Outputs& outputs);
  void go(const View& view, bool renew, Outputs& outputs);
  bool steps_back(const LinkView& body, const View& view, bool renew, Outputs& outputs);
  void go_round(const LinkView& body, const View& view, bool renew, Outputs& outputs);
  Scan scan_surroundings(const LinkView& body, const View& view);
  void find_rejoin(const Vec2& at);
  std::optional<Vec2> way_for(const Vec2& at, const Vec2& to) const;
  Vec2 steer(const LinkView& body, const Vec2& to, double fastest);
  double slowed(const Vec2& at, const Vec2& direction, double speed);
  void head_for(const Vec2& velocity, double turn, Outputs& outputs);
  void make_room(const LinkView& body, Nanoseconds now);
  void note_progress(const Vec2& at, const Vec2& goal, bool on_path, Nanoseconds step);
  void stand(Outputs& outputs);
  double sound() const;
  void show(Mode mode, const LinkView& body, bool renew, Outputs& outputs);

  LinkRef body_;
  Path path_;
  Refresh refresh_;
  double force_max_ = 0.0;       // N
  double step_sound_ = 0.0;      // dB over 1 pW
  double speech_sound_ = 0.0;    // dB over 1 pW
  Nanoseconds clock_ = 0;        // time on the path; below 0 while the start is delayed
  Nanoseconds stalled_ = 0;      // since it last came on
  Vec2 came_to_ = Vec2::Zero();  // where that was
  Nanoseconds away_until_ = 0;   // of stepping back
  Vec2 back_to_ = Vec2::Zero();  // where it does so
  struct Order {
    Vec2 to;  // m, world
    bool pushes = false;
    bool arrived = false;
  };
  std::optional<Order> order_;  // in place of its path
  double speed_ = 1.0;          // m/s, on an order
  bool avoids_ = true;
  Surroundings surroundings_;
  Nanoseconds scanned_at_ = -1;        // that, as a multiple of kScanPeriod
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

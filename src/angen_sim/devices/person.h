#pragma once

#include <memory>
#include <string>

#include "devices/path.h"
#include "devices/refresh.h"
#include "plugin/plugin.h"

namespace angen::devices {

/// Walks a path by a motor of limited force. What does not give way stops it, and its path waits;
/// it steps back from time to time, so that a door can open towards it.
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
  enum class Mode { kStanding, kWalking, kBlocked };

  static Path read_path(Params& params);
  void start(const LinkView& body);
  void walk(const Path::Place& place, const View& view, bool renew, Outputs& outputs);
  void head_for(const Vec3& way, double fastest, double turn, Outputs& outputs);
  void make_room(const LinkView& body, Nanoseconds now);
  void watch(const Vec3& at, const Path::Place& goal, bool on_path, Nanoseconds step);
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
  Vec3 came_to_ = Vec3::Zero();  // where that was
  Nanoseconds away_until_ = 0;   // of stepping back
  Vec3 back_to_ = Vec3::Zero();  // where it does so
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

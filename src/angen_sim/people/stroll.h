#pragma once

#include <optional>
#include <utility>

#include "core/time.h"
#include "people/path.h"
#include "people/surroundings.h"

namespace angen::people {

constexpr double kPushedAway = 0.1;  // m: who was pushed further than this walks back
constexpr Nanoseconds kPathAhead = 7 * kSecond / 5;  // the part of a path that has to be free

/// A person's walk along its path, by a clock of its own: it waits while the person lags behind,
/// and runs on to where the person comes back from a way round.
class Stroll {
 public:
  using Vec2 = Surroundings::Vec2;

  Stroll() = default;
  /// `clock`: the time on the path, below 0 while the start is delayed.
  Stroll(Path path, Nanoseconds clock) : path_(std::move(path)), clock_(clock) {}

  bool has_path() const { return !path_.empty(); }
  void stay_at(const Pose& pose);
  Nanoseconds clock() const { return clock_; }
  void advance(Nanoseconds time) { clock_ += time; }
  /// Whether its clock has advanced since the last call.
  bool comes() { return clock_ > std::exchange(seen_, clock_); }

  Path::Place now() const { return path_.at(clock_); }
  Path::Place in(Nanoseconds time) const { return path_.at(clock_ + time); }
  Vec2 place_in(Nanoseconds time) const;
  /// The time from now on until its path goes on, kForever if it does not.
  Nanoseconds still_for() const;
  /// A place that much (m) back on the path.
  Vec2 back_from(const Vec2& at, double away) const;

  void hold() { held_at_ = clock_; }
  /// Whether who was held has come on since.
  bool is_free() const;

  /// Where it comes back to its path after a way round, as a time of that.
  const std::optional<Nanoseconds>& rejoin() const { return rejoin_; }
  void rejoin_in(Nanoseconds time) { rejoin_ = clock_ + time; }
  void stay_on_path() { rejoin_.reset(); }
  Path::Place rejoin_place() const { return path_.at(*rejoin_); }

 private:
  Path path_;
  Nanoseconds clock_ = 0;
  Nanoseconds seen_ = 0;     // the clock at the last comes()
  Nanoseconds held_at_ = 0;  // when something began to hold it
  std::optional<Nanoseconds> rejoin_;
};

}  // namespace angen::people

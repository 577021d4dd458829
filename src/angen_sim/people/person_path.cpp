// A person's walk along its path, and round what is on it.
#include <algorithm>
#include <cmath>
#include <vector>

#include "people/person.h"
#include "plugin/outputs.h"
#include "plugin/view.h"

namespace angen::people {

namespace {

constexpr double kMaxPathLag = 0.3;  // m behind the path: further, and the path waits
constexpr double kProgress = 0.05;   // m: less than this in a second is none
constexpr double kCatchUp = 1.3;     // times the path's own speed
constexpr double kThere = 0.01;      // m: tolerance of its goal
constexpr double kFacing = 0.02;     // rad
constexpr double kNearPath = 0.1;    // m: nearer than this it is not held
constexpr double kNearRejoin = 0.3;  // m
constexpr Nanoseconds kRejoinWithin = 6 * kSecond;

}  // namespace

void Person::stroll(const Path::Place& place, const Step& step) {
  walker_.look_down(step.view, step.feet());
  if (gives_way(step)) return;
  const bool near =
      walker_.rests() && place.still() && (Vec2(place.x, place.y) - step.at()).norm() < kPushedAway;
  Look look = Look::kNone;
  if (avoids_ && !near && !is<WaitsAtDoor>()) {
    look = walker_.look(step.view, step.feet());
    if (look == Look::kPlans && stroll_.rejoin()) {
      const Path::Place end = stroll_.rejoin_place();
      walker_.aim_for(step.view, step.feet(), {end.x, end.y});
    }
    if (look != Look::kNone) find_rejoin(step);
  }
  std::vector<Vec2> ahead;
  if (look != Look::kNone) ahead.push_back(stroll_.place_in(kPathAhead));
  if (!near && uses_door(ahead, step)) return;
  if (stroll_.rejoin()) {
    go_round(step);
  } else {
    walk_path(place, step);
  }
}

void Person::walk_path(const Path::Place& place, const Step& step) {
  const Vec2 at = step.at();
  const Path::Place goal = stroll_.in(from_seconds(kAhead));
  const Vec2 to(goal.x, goal.y);
  const double lag = std::hypot(place.x - at.x(), place.y - at.y());
  const double turn = std::remainder(goal.yaw - yaw_of(step.body.pose.rotation), 2.0 * M_PI);
  // Ahead of its place is no reason to wait, so it is the way to the goal that counts.
  const bool waits =
      (to - at).norm() > kMaxPathLag + std::hypot(goal.x - place.x, goal.y - place.y);
  if (!waits) stroll_.advance(step.view.step());
  if (stroll_.is_free()) progress_.free();
  const bool on_path = lag < (place.still() ? kThere : kNearPath);
  const bool nearer = progress_.nearer_by(at, to) > kProgress;
  const bool comes = stroll_.comes();
  note({on_path || comes, on_path || nearer, walker_.goes_round()}, step);

  const bool there = lag < kThere && std::abs(turn) < kFacing;
  if (place.still() && (there || (walker_.rests() && lag < kPushedAway))) {
    if (!walker_.rests()) stand(step.outputs);
    progress_.free();
    return show(Mode::kStanding, step);
  }
  walker_.aim_straight();
  const double fastest = std::max(kReturnSpeed, kCatchUp * std::hypot(place.vx, place.vy));
  walker_.walk(step.body, to, fastest, step.outputs, turn);
  show(progress_.is_held() ? Mode::kBlocked : Mode::kWalking, step);
}

// The path's clock advances up to the point of return, and waits for the person there.
void Person::go_round(const Step& step) {
  const Vec2 at = step.at();
  const Path::Place end = stroll_.rejoin_place();
  const Vec2 to(end.x, end.y);
  const Nanoseconds last = *stroll_.rejoin() - from_seconds(kAhead);
  if (stroll_.clock() < last) stroll_.advance(step.view.step());
  if (stroll_.clock() >= last && (to - at).norm() < kNearRejoin) stroll_.stay_on_path();
  if (stroll_.is_free()) progress_.free();
  const bool nearer = progress_.nearer_by(at, to) > kProgress;
  note({stroll_.comes(), nearer, walker_.goes_round()}, step);
  const double fastest = std::max(kReturnSpeed, std::hypot(end.vx, end.vy));
  walker_.walk(step.body, to, fastest, step.outputs);
  show(progress_.is_held() ? Mode::kBlocked : Mode::kWalking, step);
}

// If an obstacle is on the path ahead, or on the way to it: the first place behind the obstacle.
void Person::find_rejoin(const Step& step) {
  const Vec2 at = step.at();
  const Surroundings& seen = walker_.surroundings();
  const Nanoseconds ahead = from_seconds(kAhead);
  bool blocked = !seen.is_free(at, stroll_.place_in(ahead));
  for (Nanoseconds t = ahead; t <= kPathAhead; t += ahead) {
    blocked = blocked || seen.is_occupied(stroll_.place_in(t));
  }
  if (!blocked) return stroll_.stay_on_path();
  if (stroll_.rejoin()) {
    const Path::Place end = stroll_.rejoin_place();
    if (!seen.is_occupied({end.x, end.y})) return;
  }
  stroll_.stay_on_path();
  bool behind = false;
  for (Nanoseconds t = ahead; t < kRejoinWithin; t += kScanPeriod) {
    const Vec2 place = stroll_.place_in(t);
    if ((place - at).norm() > Surroundings::kSight) return;
    if (seen.is_occupied(place)) {
      behind = true;
    } else if (behind || !seen.is_free(at, place)) {
      if (walker_.aim_past(step.view, step.feet(), place)) stroll_.rejoin_in(t);
      return;
    }
  }
}

}  // namespace angen::people

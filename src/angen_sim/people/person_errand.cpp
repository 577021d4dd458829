// A person's way to where it was sent.
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/text.h"
#include "people/person.h"
#include "people/places.h"
#include "people/right_of_way.h"
#include "plugin/outputs.h"
#include "plugin/view.h"

namespace angen::people {

namespace {

constexpr double kShutsFrom = 1.6;   // m from a leaf that is in its way
constexpr double kFalls = 3.5;       // m/s: a fall of 0.6 m
constexpr double kBesideLeaf = 1.5;  // m from its hinge
constexpr double kUnseen = 0.3;      // m to an obstacle that it does not see

std::string place_text(const Surroundings::Vec2& place) {
  return text_of(place.x(), " ", place.y());
}

}  // namespace

void Person::begin_ride(const Step& step) {
  const Home& home = step.view.home();
  const int floor = *std::exchange(floor_, std::nullopt);
  const int here = floor_at(home.storeys, step.feet().z());
  if (floor == here) return;
  ride_ = Ride::between(home, here, floor, errand_->to());
  if (ride_) ride_->start_at(step.at(), step.now());
  if (!ride_) give_up(unserved(floor, home, step.feet()), step.outputs);
}

// Returns whether it walks.
bool Person::follow_ride(const Step& step) {
  const Ride::Advice next = ride_->update(step.view, *errand_, step.outputs);
  switch (next.step) {
    case Ride::Advice::Step::kStand:
      if (!walker_.rests()) stand(step.outputs);
      show(Mode::kStanding, step);
      return false;
    case Ride::Advice::Step::kWalk:
      if (errand_->to() != next.to) walk_to(next.to, false);
      return true;
    case Ride::Advice::Step::kLeft:
      ride_.reset();
      walk_to(next.to, false);
      return true;
    case Ride::Advice::Step::kFailed:
      const Vec2 goal = ride_->goal();
      ride_.reset();
      walk_to(goal, false);
      give_up(next.why, step.outputs);
      return true;
  }
  return true;
}

void Person::run_errand(const Step& step) {
  Errand& errand = *errand_;
  const Vec2 at = step.at();
  const bool rests = walker_.rests();
  const bool there = errand.is_there(at, rests, progress_.is_held());
  const auto gave_up = [&] { return errand.phase() == Errand::Phase::kGaveUp; };
  if (!there && !gave_up() && errand.begin(at, step.now())) {
    progress_.restart(step.now());
    if (!plan(step, false)) give_up(why_no_way(step), step.outputs);
  }
  const bool waits = is<WaitsAtDoor>() || is<StandsAside>() ||
                     (is<Progress::Wait>() && have_others_to_go(step.view, step.feet()));
  const bool lingers = !there && errand.lingers(at, step.now(), waits, rests, speed_);
  if (lingers && !gave_up()) give_up(what_holds(step), step.outputs);
  const bool falls = !ride_ && step.body.linear_velocity.z() < -kFalls;
  if (falls && !errand.is_over()) give_up("it has fallen from its floor", step.outputs);
  if (there || gave_up()) {
    if (!rests) errand.stop_at(at);
    if (!gave_up()) arrive(step.outputs);
    progress_.free();
    if (!rests) stand(step.outputs);
    return show(Mode::kStanding, step);
  }
  walker_.look_down(step.view, step.feet());
  if (gives_way(step)) return;
  const Look look = is<WaitsAtDoor>() ? Look::kNone : walker_.look(step.view, step.feet());
  if (look != Look::kNone || !navigator_.target()) navigator_.advance(at, errand.to());
  if (stands_aside(look, step)) return;
  const bool looks = look != Look::kNone;
  if (uses_door(looks ? navigator_.ahead() : std::vector<Vec2>{}, step)) return;
  if (look == Look::kPlans) {
    const bool knows = navigator_.knows_obstacles();
    std::optional<double> leaf;
    if (knows || walker_.goes_round()) leaf = way_to_leaf(step);
    const bool explores = knows || leaf || is_held_at_leaf(step);
    const bool found = !explores || explore(step);
    if (!found && (!leaf || *leaf < kShutsFrom)) return wait(step);  // it walks up to a leaf
    walker_.aim_straight();
    if (found) {
      walker_.aim_for(step.view, step.feet(),
                      up_to_door(step.view, step.feet(), *navigator_.target()));
    }
  }
  const double left = navigator_.left(at, errand.to());
  const bool nearer = errand.come(left);
  if (errand.is_free(left)) progress_.free();
  note({nearer, nearer, walker_.goes_round()}, step);
  walker_.slide(progress_.is_held());
  walker_.walk(step.body, *navigator_.target(), speed_, step.outputs);
  walker_.slide(false);
  show(progress_.is_held() ? Mode::kBlocked : Mode::kWalking, step);
}

bool Person::plan(const Step& step, bool with_seen) {
  if (errand_->pushes()) {
    navigator_.go_straight();
    return Surroundings::has_floor(step.view, step.feet(), errand_->to());
  }
  return navigator_.plan(step.view, step.feet(), errand_->to(), with_seen);
}

void Person::arrive(Outputs& outputs) {
  const bool is_over = errand_->is_over();
  errand_->arrive();
  if (!ride_ && !is_over) outputs.event("arrived", place_text(errand_->to()));
}

void Person::give_up(std::string why, Outputs& outputs) {
  if (is<Progress::Wait>()) state_ = Walks{};
  if (!ride_) outputs.event("unreachable", place_text(errand_->to()) + ": " + why);
  errand_->give_up(std::move(why));  // on a ride it tries again
}

std::string Person::why_no_way(const Step& step) const {
  return navigator_.why_not(step.view, step.feet(), errand_->to());
}

// What blocks a person who makes no progress.
std::string Person::what_holds(const Step& step) const {
  const Vec2 way = navigator_.target().value_or(errand_->to()) - step.at();
  std::string model = navigator_.what_blocks(step.view, step.feet(), errand_->to());
  if (model.empty()) model = Surroundings::model_ahead(step.view, step.feet(), way.normalized());
  if (!model.empty()) return model + " is in its way";
  if (have_others_to_go(step.view, step.feet())) return "others are in its way";
  return why_no_way(step);
}

bool Person::is_going() const { return ride_ || floor_ || (errand_ && !errand_->is_over()); }

// m to an open leaf across its way.
std::optional<double> Person::way_to_leaf(const Step& step) const {
  std::optional<double> least;
  for (const DoorSeen& door : doors_seen(step.view, step.feet().z())) {
    const std::optional<double> way = door.way_to_leaf(step.at(), *navigator_.target());
    if (way && (!least || *way < *least)) least = way;
  }
  return least;
}

// Whether something holds it beside an open leaf, round which the way that it sees leads nowhere.
bool Person::is_held_at_leaf(const Step& step) const {
  if (!progress_.is_held() || !walker_.goes_round()) return false;
  const std::vector<DoorSeen> doors = doors_seen(step.view, step.feet().z());
  return std::any_of(doors.begin(), doors.end(), [&](const DoorSeen& door) {
    return door.is_open() && (door.hinge - step.at()).norm() < kBesideLeaf;
  });
}

// Once an obstacle has held it on its way, or at an open leaf, it plans again with all that it
// sees.
bool Person::explore(const Step& step) {
  navigator_.learn(step.view, step.feet(), walker_.surroundings());
  if (!plan(step, true)) return false;
  errand_->set_left(navigator_.left(step.at(), errand_->to()));
  navigator_.advance(step.at(), errand_->to());
  return true;
}

// Instead of the way through a door that does not open.
void Person::take_other_way(const Step& step) {
  navigator_.note_failed(doors_.door(), doors_.why());
  doors_.reset();
  state_ = Walks{};
  navigator_.drop_target();
  if (plan(step, true)) {
    errand_->set_left(navigator_.left(step.at(), errand_->to()));
  } else {
    give_up(why_no_way(step), step.outputs);
  }
}

// With the obstacles that it sees, and one ahead if it is held by something unseen.
bool Person::finds_new_way(const Step& step) {
  const Vec2 at = step.at();
  const Surroundings& seen = walker_.surroundings();
  navigator_.learn(step.view, step.feet(), seen);
  const Vec2 ahead = (navigator_.target().value_or(errand_->to()) - at).normalized();
  if (seen.free_way(at, ahead) > kUnseen) navigator_.note_obstacle(at + kUnseen * ahead);
  const bool found = plan(step, true);
  navigator_.drop_target();
  if (found) begin_new_way(at);
  return found;
}

void Person::begin_new_way(const Vec2& at) {
  const double left = navigator_.left(at, errand_->to());
  errand_->set_left(left);
  errand_->hold_at(left);
}

}  // namespace angen::people

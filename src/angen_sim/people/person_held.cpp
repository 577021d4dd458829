// A person at doors, and its behavior when something holds it.
#include <string>
#include <vector>

#include "people/person.h"
#include "people/right_of_way.h"
#include "plugin/outputs.h"
#include "plugin/view.h"

namespace angen::people {

namespace {

constexpr double kStepBack = 1.2;  // m, out of the way of a leaf that opens towards it
constexpr double kAtPlace = 0.1;   // m from where it waits
constexpr Nanoseconds kWalksAside = 4 * kSecond;    // then it waits where it is
constexpr Nanoseconds kStandsAside = 60 * kSecond;  // then it goes on, whoever comes
constexpr Nanoseconds kGivesUp = 15 * kSecond;      // without progress towards where it was sent
constexpr Nanoseconds kGivesUpInCrowd = 60 * kSecond;

}  // namespace

bool Person::uses_door(const std::vector<Vec2>& places, const Step& step) {
  if (!walker_.manner().looks || !walker_.manner().rounds) return false;
  using Advice = DoorUse::Advice::Step;
  const DoorUse::Advice advice = doors_.update(step.view, step.feet(), places, step.outputs);
  const bool waits = advice.step == Advice::kWait || advice.step == Advice::kFailed;
  state_ = waits ? State(WaitsAtDoor{}) : State(Walks{});
  if (advice.step == Advice::kWalk) return false;
  const Vec2 at = step.at();
  progress_.come(at, step.now());
  if (waits) {
    hold(at);
    if (advice.step == Advice::kFailed && errand_) take_other_way(step);
    if (!walker_.rests()) stand(step.outputs);
    show(Mode::kBlocked, step);
    return true;
  }
  if (advice.step == Advice::kStand) {
    walker_.face(step.body, advice.to - at, step.outputs);
  } else {
    if (!places.empty()) walker_.aim_for(step.view, step.feet(), advice.to);
    walker_.walk(step.body, advice.to, errand_ ? speed_ : kReturnSpeed, step.outputs);
  }
  show(progress_.is_held() ? Mode::kBlocked : Mode::kWalking, step);
  return true;
}

// Two who meet in a doorway block each other for good: who is not the next to go in waits beside
// the way.
bool Person::stands_aside(Look look, const Step& step) {
  auto* aside = std::get_if<StandsAside>(&state_);
  if (errand_->pushes() || doors_.is_busy()) return false;
  const Vec2 at = step.at();
  if (look != Look::kNone || (aside != nullptr && walker_.rests())) {
    const std::optional<Vec2> place =
        place_to_wait(step.view, step.feet(), navigator_.passages(),
                      aside != nullptr ? std::optional(aside->place) : std::nullopt);
    const bool late = aside != nullptr && step.now() - aside->since > kStandsAside;
    if (!place || late) {
      if (aside != nullptr) state_ = Walks{};
      return false;
    }
    if (aside == nullptr) aside = &state_.emplace<StandsAside>(StandsAside{at, step.now(), 0});
    if (aside->place != *place) *aside = {*place, aside->since, step.now() + kWalksAside};
  }
  if (aside == nullptr) return false;
  progress_.come(at, step.now());
  const bool there = (aside->place - at).norm() < kAtPlace;
  if (there || step.now() > aside->walks_until) {
    if (!walker_.rests()) stand(step.outputs);
    show(Mode::kBlocked, step);
    return true;
  }
  if (look == Look::kPlans) walker_.aim_for(step.view, step.feet(), aside->place);
  walker_.walk(step.body, aside->place, speed_, step.outputs, 0.0);
  show(Mode::kWalking, step);
  return true;
}

// A door that opens towards a person before it needs room: the person steps back the way it came,
// waits there, and continues when it sees a free way. Rarely it tries without seeing one.
bool Person::gives_way(const Step& step) {
  if (progress_.must_make_room()) make_room(step);
  auto* const wait = std::get_if<Progress::Wait>(&state_);
  if (wait == nullptr) return false;
  const bool backs = step.now() < wait->away_until;
  const bool looks = backs ? walker_.look(step.view, step.feet()) == Look::kPlans
                           : step.now() / kSecond != wait->checked_at;
  if (looks && shuts_leaf(step)) {
    wait->away_until = wait->since = step.now();
    wait->retry_at = step.now() + kSecond;
  }
  if (backs) {
    walker_.aim_straight();
    walker_.slide(true);  // the way back may be along a wall
    walker_.walk(step.body, wait->back_to, kReturnSpeed, step.outputs, 0.0);
    walker_.slide(false);
    progress_.count_from(step.at());
    show(Mode::kBlocked, step);
    return true;
  }
  if (looks) {
    wait->checked_at = step.now() / kSecond;
    if (is_freed(*wait, step)) {
      state_ = Walks{};
      walker_.look_anew();
      progress_.resume(step.at(), step.now());
      return false;
    }
    const bool crowded = have_others_to_go(step.view, step.feet());
    const Nanoseconds patience = crowded ? kGivesUpInCrowd : kGivesUp;
    if (walker_.manner().rounds && errand_ && step.now() - wait->since > patience) {
      if (!doors_.shut_nearby(step.view, step.feet(), step.outputs)) {
        give_up(what_holds(step), step.outputs);
        return false;
      }
      wait->since = step.now();
    }
  }
  if (!walker_.rests()) stand(step.outputs);
  show(Mode::kBlocked, step);
  return true;
}

// Shuts an open leaf that is in its way, once it is out of the swing of that.
bool Person::shuts_leaf(const Step& step) {
  if (!errand_ || !walker_.manner().rounds) return false;
  const Vec2 way = navigator_.target().value_or(errand_->to()) - step.at();
  const std::string leaf = Surroundings::model_ahead(step.view, step.feet(), way.normalized());
  return !leaf.empty() && doors_.shut_nearby(step.view, step.feet(), step.outputs, leaf);
}

// Shuts the open leaf without which there would be a way, from where it is out of the swing, or
// waits for one in motion.
bool Person::makes_for_leaf(const Step& step) {
  if (!errand_ || !walker_.manner().rounds || doors_.is_busy()) return false;
  if (doors_.wait_for_leaf(step.view, step.feet())) return true;
  const std::optional<Navigator::LeafInWay> leaf =
      navigator_.leaf_in_way(step.view, step.feet(), errand_->to());
  if (!leaf) return false;
  navigator_.forget_leaf(leaf->door);
  doors_.go_and_shut(leaf->door, leaf->place, step.now());
  return true;
}

bool Person::is_freed(const Progress::Wait& wait, const Step& step) {
  const bool plans = errand_ && !errand_->pushes();
  if (step.now() >= wait.blind_at && !plans) return true;
  if (step.now() < wait.retry_at) return false;
  const Surroundings& seen = walker_.scan(step.view, step.feet());
  if (plans) {
    navigator_.learn(step.view, step.feet(), seen);
    if (!plan(step, true)) return false;
    begin_new_way(step.at());
    navigator_.drop_target();
  } else if (!seen.reaches(step.at(), errand_ ? errand_->to() : stroll_.place_in(kPathAhead))) {
    return false;
  }
  progress_.err();  // unless it comes on
  return true;
}

// First it looks for another way to where it was sent.
void Person::make_room(const Step& step) {
  progress_.rest();
  if (errand_ && !errand_->pushes() && finds_new_way(step)) {
    progress_.restart(step.now());
  } else {
    wait(step);
  }
}

void Person::wait(const Step& step) {
  if (makes_for_leaf(step)) return;
  const Vec2 at = step.at();
  hold(at);
  Progress::Wait wait = progress_.wait(step.now());
  if (errand_) {
    const Vec2 ahead = (navigator_.target().value_or(errand_->to()) - at).normalized();
    wait.back_to = at - kStepBack * ahead;
  } else {
    wait.back_to = stroll_.back_from(at, kStepBack);
  }
  state_ = wait;
}

void Person::note(const Progress::Step& progress, const Step& step) {
  if (progress_.note(step.at(), progress, step.now(), step.view.step())) hold(step.at());
}

void Person::hold(const Vec2& at) {
  if (progress_.is_held()) return;
  progress_.hold();
  stroll_.hold();
  if (errand_) errand_->hold_at(navigator_.left(at, errand_->to()));
}

}  // namespace angen::people

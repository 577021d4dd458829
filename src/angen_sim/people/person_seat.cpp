// How a person sits down, lies down and gets up.
#include <utility>

#include "people/person.h"
#include "plugin/outputs.h"
#include "plugin/view.h"

namespace angen::people {

namespace {

constexpr int kRiseTries = 20;  // one a second

}  // namespace

Verdict Person::command_posture(const Command& command, const View& view) {
  if (command.verb == "Stand") {
    if (!seat_) return Verdict::accept([] {});
    if (!place_to_stand(view, *seat_)) return Verdict::reject("others leave it no room to get up");
    return Verdict::accept([this] { paused_ = stands_up_ = true; });
  }
  if (!can_sit_) return Verdict::reject("its body can neither sit nor lie");
  FoundSeat found = find_seat(command, view, stands_at(view));
  if (!found.seat) return Verdict::reject(std::move(found.why_not));
  if (seat_ && !started_) found.seat->stand = seat_->stand;  // it is found at the start
  return Verdict::accept([this, seat = *found.seat] {
    floor_.reset();
    ride_.reset();
    errand_.reset();
    start_anew();
    paused_ = true;
    settled_ = stands_up_ = false;
    seat_ = seat;
  });
}

// Also of one who sits or lies.
Pose Person::stands_at(const View& view) const {
  Pose body = view.link(link_).pose;
  if (seat_ && started_) body.position = seat_->stand;
  return body;
}

// Returns whether it sits or lies, or has just got up.
bool Person::sits(const Step& step) {
  const Mode mode = seat_->posture == Posture::kSit ? Mode::kSitting : Mode::kLying;
  if (!std::exchange(settled_, true)) {
    gives_.take(seat_->posture);
    step.outputs.posture(link_, static_cast<int>(seat_->posture), seat_->at);
    stand(step.outputs);
    rise_tries_ = 0;
    rises_at_ = 0;
    show(mode, step);
  }
  const bool rises = !paused_ || stands_up_;
  if (rises && step.now() >= rises_at_) rise(step);
  if (seat_ && step.renew) show(mode, step);
  return true;
}

// One who is sent elsewhere waits for others to leave it room, for a while.
void Person::rise(const Step& step) {
  const std::optional<Vec3> place = place_to_stand(step.view, *seat_);
  if (!place) {
    rises_at_ = step.now() + kSecond;
    if (++rise_tries_ < kRiseTries) return;
    paused_ = true;
    stands_up_ = false;
    if (errand_) give_up("others leave it no room to get up", step.outputs);
    return;
  }
  gives_.take(Posture::kStand);
  step.outputs.posture(link_, 0, {*place, step.body.pose.rotation});
  seat_.reset();
  stands_up_ = false;
  progress_.count_from(place->head<2>());
  if (!errand_) stroll_.stay_on_path();
  show(Mode::kStanding, step);
}

}  // namespace angen::people

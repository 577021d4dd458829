#include "people/ride.h"

#include <utility>

#include "plugin/outputs.h"
#include "plugin/view.h"

namespace angen::people {

namespace {

constexpr Nanoseconds kCallsAgain = 10 * kSecond;  // another may have sent it elsewhere
constexpr Nanoseconds kLiftLate = 120 * kSecond;   // then it gives up
constexpr double kInCabin = 0.5;                   // m from its middle
constexpr int kBoardings = 3;                      // doors that shut before it, at most

}  // namespace

std::optional<Ride> Ride::between(const Home& home, int from, int to, const Vec2& goal) {
  for (const HomeElevator& elevator : home.elevators) {
    Ride ride;
    bool has_from = false;
    bool has_to = false;
    for (std::size_t i = 0; i < elevator.landings.size(); ++i) {
      const Landing& landing = elevator.landings[i];
      const Stop stop{landing.storey, static_cast<int>(i), landing.pose.position.head<2>()};
      if (landing.storey == from) ride.from_ = stop, has_from = true;
      if (landing.storey == to) ride.to_ = stop, has_to = true;
    }
    if (!has_from || !has_to) continue;
    ride.elevator_ = elevator.name;
    ride.cabin_ = elevator.pose.position.head<2>();
    ride.goal_ = goal;
    return ride;
  }
  return std::nullopt;
}

void Ride::start_at(const Vec2& at, Nanoseconds now) {
  if ((at - cabin_).norm() > kInCabin) return;
  begun_ = true;
  enter(Phase::kRides, now);
}

void Ride::enter(Phase phase, Nanoseconds now) {
  phase_ = phase;
  since_ = now;
  called_at_ = -1;
}

Ride::Advice Ride::update(const View& view, const Errand& errand, Outputs& outputs) {
  using Step = Advice::Step;
  if (!std::exchange(begun_, true)) return {Step::kWalk, from_.wait};
  const bool arrived = errand.phase() == Errand::Phase::kArrived;
  const bool gave_up = errand.phase() == Errand::Phase::kGaveUp;
  switch (phase_) {
    case Phase::kToLanding:
      if (gave_up) return {Step::kFailed, {}, errand.why()};
      if (!arrived) return {Step::kWalk, from_.wait};
      enter(Phase::kCalls, view.time());
      return {};
    case Phase::kCalls:
      return wait_for(from_, cabin_, Phase::kBoards, view, outputs);
    case Phase::kBoards:
      if (arrived) {
        enter(Phase::kRides, view.time());
        return {};
      }
      if (!gave_up) return {Step::kWalk, cabin_};
      if (++tries_ == kBoardings) {
        return {Step::kFailed, {}, "it does not get into elevator " + elevator_};
      }
      enter(Phase::kToLanding, view.time());  // its doors were shut before
      return {Step::kWalk, from_.wait};
    case Phase::kRides:
      return wait_for(to_, to_.wait, Phase::kLeaves, view, outputs);
    case Phase::kLeaves:
      if (gave_up) return {Step::kFailed, {}, errand.why()};
      return arrived ? Advice{Step::kLeft, goal_} : Advice{Step::kWalk, to_.wait};
  }
  return {};
}

// Calls the elevator until it stands there with open doors.
Ride::Advice Ride::wait_for(const Stop& stop, const Vec2& then, Phase next, const View& view,
                            Outputs& outputs) {
  const Nanoseconds now = view.time();
  const Reading* lift = state(view);
  if (lift == nullptr) {
    if (now - since_ < kSecond) return {};  // it has reported nothing at the start
    return {Advice::Step::kFailed, {}, "elevator " + elevator_ + " is gone"};
  }
  const auto& doors = lift->get<std::string>("door_mode");
  if (lift->get<std::int64_t>("floor") == stop.number && doors == "OPEN") {
    enter(next, now);
    return {Advice::Step::kWalk, then};
  }
  if (now - since_ > kLiftLate) {
    return {Advice::Step::kFailed,
            {},
            "elevator " + elevator_ + " has not come within " +
                std::to_string(kLiftLate / kSecond) + " s; it is " +
                lift->get<std::string>("mode") + ", its doors are " + doors};
  }
  if (called_at_ < 0 || now - called_at_ > kCallsAgain) {
    called_at_ = now;
    outputs.command("elevator", elevator_, "Floor" + std::to_string(stop.number));
  }
  return {};
}

const Reading* Ride::state(const View& view) const {
  const std::optional<DeviceView> lift = view.device("door_mode", "elevator", elevator_);
  return lift ? &lift->state : nullptr;
}

}  // namespace angen::people

#include "devices/weighing.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "plugin/view.h"

namespace angen::devices {

namespace {

constexpr double kWeighShare = 0.2;        // share of each new weighing, at the rate of publishing
constexpr double kStandardGravity = 9.81;  // m/s^2
constexpr double kGreatestLoad = 2000.0;   // kg, or twice the rated load: more is a blow

// An overload is more than the rated load by 10 %, and by 75 kg at least (EN 81-20, 5.12.1.2).
constexpr double kRatedLoad = 630.0;  // kg, eight persons
constexpr double kOverShare = 0.1;
constexpr double kLeastOver = 75.0;                    // kg
constexpr Nanoseconds kWeighingSettles = kSecond / 2;  // boarding loads drop on the floor

}  // namespace

void Weighing::configure(Params& params) {
  rated_load_ = params.number("rated_load", kRatedLoad, "kg",
                              "it stays, with open doors, under more than this by 10 % (by 75 kg "
                              "at least)",
                              kPositive);
}

double Weighing::load() const { return std::max(0.0, mass_ - own_mass_); }

bool Weighing::is_heavy() const {
  return mass_ - own_mass_ > rated_load_ + std::max(kOverShare * rated_load_, kLeastOver);
}

double Weighing::weigh(const JointView& lift, const View& view) const {
  const double gravity = -view.gravity().z();
  if (gravity <= 0.0) return mass_;
  const double greatest = std::max(kGreatestLoad, 2.0 * rated_load_);
  const double felt = std::clamp(lift.effort / gravity, own_mass_, own_mass_ + greatest);
  return mass_ + kWeighShare * (felt - mass_);
}

void Weighing::watch(const View& view) {
  if (is_heavy() == overloaded_) load_since_ = view.time();
  if (view.time() - load_since_ >= kWeighingSettles) overloaded_ = is_heavy();
}

void Weighing::warn_of_effort(Params& params, double effort, const std::string& lift) const {
  const double needed = (own_mass_ + rated_load_) * kStandardGravity;
  if (!params.has("rated_load") || needed <= effort) return;
  params.warn("rated_load", "<rated_load> and cabin weigh " + number_text(needed) +
                                " N, but the <effort> of joint '" + lift + "' allows " +
                                number_text(effort) + " N, which is all that lifts them");
}

std::string Weighing::detail() const {
  return number_text(std::round(load())) + " kg of " + number_text(rated_load_) + " kg";
}

}  // namespace angen::devices

#include "people/body.h"

#include <cmath>
#include <utility>

#include "people/metabolism.h"
#include "plugin/outputs.h"
#include "plugin/rooms.h"
#include "plugin/view.h"

namespace angen::people {

namespace {

constexpr double kUsualMass = 70.0;             // kg, of a body of 1.8 m^2
constexpr double kMouths[] = {1.5, 0.68, 0.2};  // m: where its sound comes from, by posture
constexpr double kMiddle = 0.9;                 // m above its feet
constexpr double kCelsiusZero = 273.15;         // K
constexpr double kFelt = 0.02;                  // K: smaller changes of the air are not felt
constexpr double kFeltHumidity = 0.5;           // percent
constexpr double kUsualHumidity = 50.0;         // percent, if the world has no climate
constexpr double kRoomAir = 295.15;             // K, at which …
constexpr double kSkinAtRest = 307.0;           // K … is that of head and hands
constexpr double kSkinPerKelvin = 0.12;         // share of the air's
constexpr double kCoveredSkin = 306.5;          // K, below clothing
constexpr double kClothingShare = 0.35;         // share of the way from the air to the skin
constexpr double kBareShare = 0.12;             // share of its surface: head and hands
constexpr double kWarmsBy = 0.1;                // K in a period, of its surface; ours
constexpr Nanoseconds kAirPeriod = 10 * kSecond;
constexpr Range kSoundPower{-100.0, 200.0};

}  // namespace

void Body::configure(Params& params, Wiring& wiring) {
  const double mass = params.number("mass", kUsualMass, "kg", "its mass", kPositive);
  // Meeh's law: the surface of bodies of one shape.
  surface_ = std::pow(mass / kUsualMass, 2.0 / 3.0);
  step_sound_ =
      params.number("step_sound", 55.0, "dB",
                    "sound power level of its steps while it walks, over 1 pW", kSoundPower);
  speech_sound_ = params.number("speech_sound", 68.4, "dB",
                                "sound power level of its speech, over 1 pW", kSoundPower);
  speaks_ = spoke_ = params.flag("speaking", false, "speaks at the start, as after Speak");
  skin_ = params.number("skin_temperature", 307.0, "K",
                        "of head and hands, seen by PIRs; follows the air unless given", kPositive);
  clothing_ = params.number("clothing_temperature", 299.0, "K",
                            "of the rest of its surface; follows the air unless given", kPositive);
  skin_follows_ = !params.has("skin_temperature");
  clothing_follows_ = !params.has("clothing_temperature");
  surfaces_ = wiring.surfaces("");
}

void Body::update(const View& view, const LinkView& link, Outputs& outputs) {
  gait_.advance(link.pose, link.linear_velocity.head<2>().norm());
  feel_air(view, link.pose.position, outputs);
  if (speaks_ != spoke_) outputs.event(speaks_ ? "speaks" : "quiet", "");
  spoke_ = speaks_;
}

Nanoseconds Body::feels_next(Nanoseconds now) { return (now / kAirPeriod + 1) * kAirPeriod; }

// Skin and clothing follow the air around. Rays hit one surface that radiates as both do; it warms
// by small steps, as a body and its clothing have heat to store.
void Body::feel_air(const View& view, const Vec3& feet, Outputs& outputs) {
  const Nanoseconds now = view.time() / kAirPeriod;
  if (now == felt_at_) return;
  const bool is_new = std::exchange(felt_at_, now) < 0;
  const AirHere here = air_at(view, feet + kMiddle * Vec3::UnitZ());
  const bool known = !std::isnan(here.temperature);
  const double air = known ? here.temperature + kCelsiusZero : view.ambient_temperature();
  const double humidity = known ? here.humidity : kUsualHumidity;
  if (std::abs(air - air_) >= kFelt || std::abs(humidity - humidity_) >= kFeltHumidity) {
    humidity_ = humidity;
    air_ = air;
    if (skin_follows_) skin_ = kSkinAtRest + kSkinPerKelvin * (air - kRoomAir);
    if (clothing_follows_) clothing_ = air + kClothingShare * (kCoveredSkin - air);
  }
  const double mean =
      std::pow(kBareShare * std::pow(skin_, 4) + (1.0 - kBareShare) * std::pow(clothing_, 4), 0.25);
  if (!is_new && std::abs(mean - warmth_) < kWarmsBy) return;
  warmth_ = is_new ? mean : warmth_ + std::copysign(kWarmsBy, mean - warmth_);
  for (const SurfaceRef surface : surfaces_) outputs.temperature(surface, warmth_, warmth_, 0.0);
}

void Body::pose_limbs(std::vector<Pose>& limbs) const {
  for (std::size_t i = 0; i < limbs.size(); ++i) limbs[i] = gait_.limb(static_cast<int>(i));
}

void Body::report(const View& view, std::optional<double> speed, Reading& state) const {
  state.set("speaking", speaks_);
  state.set("sound_power_level", sound(speed.has_value()));
  state.set("position", std::vector<double>{0.0, 0.0, kMouths[static_cast<int>(posture_)]});
  const double air = air_ > 0.0 ? air_ : view.ambient_temperature();
  const double rate = posture_ == Posture::kSit   ? kSeated
                      : posture_ == Posture::kLie ? kReclining
                                                  : metabolic_rate(speed.value_or(0.0));
  const Metabolism given = metabolism(rate, air - kCelsiusZero, humidity_);
  state.set("heat", surface_ * given.heat);
  state.set("vapor", surface_ * given.vapor);
}

// dB over 1 pW, of steps and speech together.
double Body::sound(bool walks) const {
  const double steps = walks ? std::pow(10.0, step_sound_ / 10.0) : 0.0;
  const double speech = speaks_ ? std::pow(10.0, speech_sound_ / 10.0) : 0.0;
  return 10.0 * std::log10(steps + speech);
}

}  // namespace angen::people

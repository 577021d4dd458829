#include <plugin/register.h>

#include <cmath>

namespace air_quality {

/// The CO2 of a well-mixed room: people in view breathe out, fresh air comes in (the mass
/// balance of ASTM D6245). A person is in view where the first thing on the ray to the chest is
/// near the chest.
class Co2 : public angen::Sensor {
 public:
  void configure(angen::Params& params, angen::Wiring&) override {
    volume_ = params.number("volume", 30.0, "m^3", "of the room", angen::kPositive);
    changes_ = params.number("air_changes", 0.5, "1/h", "of the room's air", angen::kNotNegative);
    emission_ =
        params.number("emission", 18.0, "L/h", "that a person breathes out", angen::kPositive);
    outdoors_ = params.number("outdoors", 420.0, "ppm", "of fresh air", angen::kPositive);
    limit_ = params.number("limit", 1000.0, "ppm", "above it the air is stale", angen::kPositive);
    reach_ =
        params.number("reach", 8.0, "m", "people farther away are not counted", angen::kPositive);
    params.noise("concentration", "ppm", "of a reading");
    concentration_ = outdoors_;
  }

  void aim(const angen::View& view, angen::RayBatch& rays) override {
    distances_.clear();
    const angen::Vec3 here = view.pose().position;
    for (const angen::DeviceView& person : view.devices("speed")) {
      if (person.kind != "person") continue;
      const angen::Vec3 way = person.pose * angen::Vec3(0.0, 0.0, kChest) - here;
      const double distance = way.norm();
      if (distance > reach_ || distance < kShoulders) continue;
      rays.push_back({here, way / distance, 0.0, distance});
      distances_.push_back(distance);
    }
  }

  void read(const angen::View& view, angen::Hits hits, angen::Rng&, angen::Reading& out) override {
    int people = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      if (hits[i].range > distances_[i] - kShoulders) ++people;
    }
    breathe(people, view.time());
    const bool stale = concentration_ > limit_;
    if (stale != stale_) out.event = stale ? "stale" : "fresh";
    stale_ = stale;
    out.set("concentration", concentration_);
    out.set("people", people);
    out.set("stale", stale);
  }

 private:
  static constexpr double kChest = 1.2;      // m above a person's frame
  static constexpr double kShoulders = 0.4;  // m: a hit nearer than this to the chest is the person

  /// The balance's closed form over the time since the last sample.
  void breathe(int people, angen::Nanoseconds now) {
    const double hours = sampled_at_ < 0 ? 0.0 : angen::to_seconds(now - sampled_at_) / 3600.0;
    sampled_at_ = now;
    const double source = people * emission_ / 1000.0 / volume_ * 1e6;  // ppm/h
    if (changes_ == 0.0) {
      concentration_ += source * hours;
      return;
    }
    const double settled = outdoors_ + source / changes_;
    concentration_ = settled + (concentration_ - settled) * std::exp(-changes_ * hours);
  }

  double volume_ = 0.0;
  double changes_ = 0.0;
  double emission_ = 0.0;
  double outdoors_ = 0.0;
  double limit_ = 0.0;
  double reach_ = 0.0;
  double concentration_ = 0.0;  // ppm
  bool stale_ = false;
  std::vector<double> distances_;  // m, as the rays
  angen::Nanoseconds sampled_at_ = -1;
};

ANGEN_REGISTER_SENSOR(Co2, Kind("co2", "The CO2 in the air of a room.")
                               .rate(1.0)
                               .example("spawn co2 c1 --pose \"1 1 1.5\" --set volume=40")
                               .number("concentration", "ppm", "by volume")
                               .shown()
                               .integer("people", "", "in view")
                               .flag("stale", "whether it is above the limit")
                               .alarm("STALE", "fresh"))

}  // namespace air_quality

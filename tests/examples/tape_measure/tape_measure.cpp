#include <plugin/register.h>

/// Measures the distance to whatever is straight ahead.
class TapeMeasure : public angen::Sensor {
 public:
  void configure(angen::Params& params, angen::Wiring&) override {
    reach_ = params.number("reach", 10.0, "m", "farther is not seen", angen::kPositive);
    noise_ = params.number("noise_stddev", 0.0, "m", "of a distance", angen::kNotNegative);
  }
  void aim(const angen::View& view, angen::RayBatch& rays) override {
    const angen::Vec3 ahead = view.pose().rotation * angen::Vec3::UnitX();
    rays.push_back({view.pose().position, ahead, 0.0, reach_});
  }
  void read(const angen::View&, angen::Hits hits, angen::Rng& rng, angen::Reading& out) override {
    out.set("met", hits[0].hit());
    out.set("distance", hits[0].hit() ? hits[0].range + noise_ * rng.gaussian() : reach_);
  }

 private:
  double reach_ = 0.0;
  double noise_ = 0.0;
};

ANGEN_REGISTER_SENSOR(TapeMeasure, "tape", "The distance straight ahead.")

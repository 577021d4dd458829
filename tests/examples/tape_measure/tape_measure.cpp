#include <plugin/register.h>

/// Measures the distance to whatever is straight ahead; infinite where nothing is in reach.
class TapeMeasure : public angen::Sensor {
 public:
  void configure(angen::Params& params, angen::Wiring&) override {
    reach_ = params.number("reach", 10.0, "m", "farther is not measured", angen::kPositive);
    params.noise("distance", "m", "of a distance");
  }
  void aim(const angen::View& view, angen::RayBatch& rays) override {
    const angen::Vec3 ahead = view.pose().rotation * angen::Vec3::UnitX();
    rays.push_back({view.pose().position, ahead, 0.0, reach_});
  }
  void read(const angen::View&, angen::Hits hits, angen::Rng&, angen::Reading& out) override {
    out.set("distance", hits[0].range);
  }

 private:
  double reach_ = 0.0;
};

ANGEN_REGISTER_SENSOR(TapeMeasure, Kind("tape", "The distance straight ahead.")
                                       .number("distance", "m", "infinite without a hit"))

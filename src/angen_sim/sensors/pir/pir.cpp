// libpir_controller.so
#include <memory>

#include "plugin/register.h"
#include "sensors/pir/pyroelectric.h"
#include "sensors/pir/range_difference.h"

namespace angen::sensors {

/// A motion detector, by one of two models.
class Pir : public Sensor, public NoisySensor {
 public:
  void configure(Params& params, Wiring& wiring) override {
    const std::string model = params.choice(
        "model", "range_difference", {"range_difference", "pyroelectric"}, "how motion is found");
    if (model == "pyroelectric") {
      model_ = std::make_unique<Pyroelectric>();
    } else {
      auto scanner = std::make_unique<RangeDifference>();
      noisy_ = scanner.get();
      model_ = std::move(scanner);
    }
    model_->configure(params, wiring);
  }
  std::optional<RayGeometry> rays() const override { return model_->rays(); }
  Nanoseconds sample_period() const override { return model_->sample_period(); }
  int ray_set(const View& view) override { return model_->ray_set(view); }
  void aim(const View& view, RayBatch& rays) override { model_->aim(view, rays); }
  void read(const View& view, Hits hits, Rng& rng, Reading& reading) override {
    model_->read(view, hits, rng, reading);
  }
  bool steady() const override { return model_->steady(); }

  bool varies() const override { return noisy_ != nullptr && noisy_->varies(); }
  double quiet_chance() const override { return noisy_->quiet_chance(); }
  int memory() const override { return noisy_->memory(); }
  std::shared_ptr<const LazyReading> lazy_reading() const override {
    return noisy_->lazy_reading();
  }
  void resume(Nanoseconds time, const Draws& draws) override { noisy_->resume(time, draws); }

 private:
  std::unique_ptr<Sensor> model_;
  NoisySensor* noisy_ = nullptr;  // the same, where its noise decides
};

ANGEN_REGISTER_SENSOR(
    Pir, Kind("pir", "A motion detector: range differences, or heat as a real one.")
             .model("pir")
             .model("pir_pyroelectric", "model", "pyroelectric")
             .example("spawn pir p1 --pose \"1 1 1.2 0 0 0\" --set ray/range/max=4")
             .rays("0 0 1 0.45")
             .flag("motion", "whether it detects motion")
             .alarm("MOTION", "still")
             .flag("departure",
                   "whether something has left since the last nod, without motion now; with model "
                   "range_difference that nods")
             .number("difference", "m",
                     "greatest, of a range from the one a sample before; with model "
                     "range_difference")
             .shown(3)
             .number("threshold", "m", "as its parameter; with model range_difference")
             .number("signal", "V", "of the elements; with model range_difference the difference")
             .number("signal_threshold", "V", "as its parameter; otherwise the threshold")
             .number("flux", "W", "on the elements; with model pyroelectric")
             .numbers("ranges", "m", "of each ray; with model range_difference"))

}  // namespace angen::sensors

#include <memory>

#include "plugin/register.h"
#include "sensors/pir/pyroelectric.h"
#include "sensors/pir/range_difference.h"

namespace angen::sensors {

/// A motion detector, by one of two models.
class Pir : public Sensor {
 public:
  void configure(Params& params, Wiring& wiring) override {
    const std::string model = params.choice(
        "model", "range_difference", {"range_difference", "pyroelectric"}, "how motion is found");
    if (model == "pyroelectric") {
      model_ = std::make_unique<Pyroelectric>();
    } else {
      model_ = std::make_unique<RangeDifference>();
    }
    model_->configure(params, wiring);
  }
  Nanoseconds sample_period() const override { return model_->sample_period(); }
  int stance(const View& view) override { return model_->stance(view); }
  void aim(const View& view, RayBatch& rays) override { model_->aim(view, rays); }
  void read(const View& view, Hits hits, Rng& rng, Reading& reading) override {
    model_->read(view, hits, rng, reading);
  }
  Rest rest() const override { return model_->rest(); }
  double quiet_chance() const override { return model_->quiet_chance(); }
  int memory() const override { return model_->memory(); }
  std::shared_ptr<const Echo> echo() const override { return model_->echo(); }
  void resume(Nanoseconds time, const Draws& draws) override { model_->resume(time, draws); }

 private:
  std::unique_ptr<Sensor> model_;
};

ANGEN_REGISTER_SENSOR(Pir, "pir", "A motion detector: range differences, or heat as a real one.")

}  // namespace angen::sensors

// libreed_contact.so
#include <optional>

#include "core/text.h"
#include "plugin/registration.h"
#include "plugin/view.h"
#include "plugin/wiring.h"

namespace angen::sensors {

/// A reed contact: it closes when the magnet on another link of its model comes near, and opens
/// when it is a little farther away.
class Reed : public Sensor {
 public:
  void configure(Params& params, Wiring& wiring) override {
    const std::string link =
        params.text("magnet_link", "", "link of the same model that carries the magnet");
    magnet_ = Vec3::Map(
        params.row("magnet", {0.0, 0.0, 0.0}, "m", "x y z of the magnet in the frame of its link")
            .data());
    operate_ = params.number("operate_distance", 0.015, "m", "closes when it is nearer", kPositive);
    release_ =
        params.number("release_distance", 0.02, "m", "opens when it is farther", {operate_, 1e3});
    sample_period_ = read_sample_period(params);
    if (link.empty()) {
      throw params.error("magnet_link",
                         "a reed contact needs the <magnet_link> that moves past it");
    }
    try {
      magnet_link_ = wiring.link(link);
    } catch (const Error& problem) {
      throw params.error("magnet_link", problem.diagnostics().front().message);
    }
  }

  void read(const View& view, Hits, Rng&, Reading& reading) override {
    const Vec3 magnet = view.link(magnet_link_).pose * magnet_;
    const double distance = (magnet - view.pose().position).norm();
    const bool closed = closed_.value_or(false) ? distance <= release_ : distance <= operate_;
    if (closed_ && closed != *closed_) {
      reading.announce(closed ? "closed" : "opened", text_of("magnet at ", distance, " m"));
    }
    closed_ = closed;
    reading.set("closed", closed);
    reading.set("distance", distance);
    reading.set("operate_distance", operate_);
    reading.set("release_distance", release_);
  }

  Nanoseconds idle_until(const Ahead&) const override { return kForever; }

 private:
  LinkRef magnet_link_;
  Vec3 magnet_ = Vec3::Zero();  // m, in its link
  double operate_ = 0.0;        // m
  double release_ = 0.0;        // m
  std::optional<bool> closed_;  // none before the first sample
};

ANGEN_REGISTER_SENSOR(
    Reed, Kind("reed", "A reed contact and its magnet on the part that opens.")
              .rate(1.0)
              .sensor_type("custom")
              .example("spawn reed r1 --on kitchen_door0::base --pose \"0.93 -0.015 2.09\" --set "
                       "magnet_link=door --set magnet=\"0.93 -0.015 2.078\"")
              .flag("closed", "whether the magnet is near")
              .shown_as("closed", "open")
              .events("opened", "closed", false)
              .number("distance", "m", "to the magnet")
              .shown(4)
              .number("operate_distance", "m", "as its parameter")
              .number("release_distance", "m", "as its parameter"))

}  // namespace angen::sensors

// librfid_reader.so
#include <cmath>
#include <map>

#include "plugin/registration.h"
#include "plugin/view.h"
#include "sensors/id_changes.h"

namespace angen::sensors {

namespace {

constexpr double kSkin = 0.01;  // m: a tag's own thickness on its carrier

}  // namespace

/// Reads the tags in its view: nearer than its range, within its beam, with nothing between.
class RfidReader : public Sensor {
 public:
  void configure(Params& params, Wiring&) override {
    range_ = params.number("max_range", 2.0, "m", "farther tags are not read", kPositive);
    const double beam = params.number("beam_angle", 2.1, "rad", "full angle of its cone about x",
                                      {1e-3, 2.0 * M_PI});
    least_cosine_ = std::cos(0.5 * beam);
  }

  void aim(const View& view, RayBatch& rays) override {
    candidates_.clear();
    const Pose reader = view.pose();
    const Vec3 ahead = reader.rotation * Vec3::UnitX();
    const Vec3 around = Vec3::Constant(range_);
    for (const DeviceView& device :
         view.devices("id", {reader.position - around, reader.position + around})) {
      if (device.kind != "tag") continue;
      const Vec3 way = device.place() - reader.position;
      const double distance = way.norm();
      if (distance > range_ || distance <= kSkin) continue;
      if (ahead.dot(way) < least_cosine_ * distance) continue;
      candidates_.push_back({device.state.get<std::string>("id"), distance});
      rays.push_back({reader.position, way / distance, 0.0, distance - kSkin});
    }
  }

  void read(const View&, Hits hits, Rng&, Reading& reading) override {
    std::map<std::string, double> seen;  // by id
    for (std::size_t i = 0; i < hits.size(); ++i) {
      if (!hits[i].hit()) seen.emplace(candidates_[i].id, candidates_[i].distance);
    }
    std::vector<std::string> ids;
    std::vector<double> distances;
    for (const auto& [id, distance] : seen) {
      ids.push_back(id);
      distances.push_back(distance);
    }
    changes_.note(ids, reading);
    reading.set("ids", std::move(ids));
    reading.set("distances", std::move(distances));
  }

  Nanoseconds idle_until(const Ahead&) const override { return changes_.pending() ? 0 : kForever; }

 private:
  struct Candidate {
    std::string id;
    double distance = 0.0;  // m
  };

  double range_ = 0.0;  // m
  double least_cosine_ = 0.0;
  std::vector<Candidate> candidates_;  // indexed like the rays of this sample
  IdChanges changes_{"read", "lost"};
};

ANGEN_REGISTER_SENSOR(RfidReader,
                      Kind("rfid", "Reads RFID tags in its range and sight.")
                          .model("rfid_reader")
                          .example("spawn rfid gate --pose \"0.2 5 1.2 0 0 0\" --set max_range=1.5")
                          .texts("ids", "of the tags that it reads, sorted")
                          .shown()
                          .numbers("distances", "m", "of these")
                          .shown(2))

}  // namespace angen::sensors

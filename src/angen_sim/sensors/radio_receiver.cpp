// libradio_receiver.so
#include <algorithm>
#include <map>
#include <set>

#include "plugin/registration.h"
#include "plugin/view.h"
#include "sensors/id_changes.h"
#include "sensors/path_loss.h"

namespace angen::sensors {

namespace {

constexpr double kSkin = 0.01;  // m: an antenna's distance from its carrier
constexpr rays::Mobilities kStatic = rays::only(rays::Mobility::kStatic);

/// The straight path from a transmitter, and the static shapes on it.
class RadioPath {
 public:
  /// All shapes on the segment (m, world), in the order in which it enters them. Static ones are
  /// searched again only if they or the ends have changed since the last call.
  std::vector<rays::Crossing> crossings(const rays::Scene& scene, const Vec3& from,
                                        const Vec3& to) {
    if (revision_ != scene.static_revision() || from != from_ || to != to_) {
      revision_ = scene.static_revision();
      from_ = from;
      to_ = to;
      fixed_ = scene.crossings(from, to, kStatic);
    }
    std::vector<rays::Crossing> all = fixed_;
    const std::vector<rays::Crossing> others = scene.crossings(from, to, rays::kAll & ~kStatic);
    const auto middle = all.insert(all.end(), others.begin(), others.end());
    std::inplace_merge(all.begin(), middle, all.end(),
                       [](const rays::Crossing& a, const rays::Crossing& b) {
                         return a.enter != b.enter ? a.enter < b.enter : a.shape < b.shape;
                       });
    return all;
  }

 private:
  std::uint64_t revision_ = 0;
  Vec3 from_ = Vec3::Zero();
  Vec3 to_ = Vec3::Zero();
  std::vector<rays::Crossing> fixed_;
};

}  // namespace

/// Receives radio transmitters: the id of each that is strong enough, and its signal strength.
class RadioReceiver : public Sensor {
 public:
  void configure(Params& params, Wiring&) override {
    sensitivity_ = params.number("sensitivity", -90.0, "dBm", "weaker signals are not received");
    hysteresis_ =
        params.number("hysteresis", 6.0, "dB",
                      "a received signal is lost this far below the sensitivity", kNotNegative);
    const double lost_after =
        params.number("lost_after", 10.0, "s",
                      "time without reception from a transmitter until it is lost", {0.0, 1e6});
    lost_after_ = from_seconds(lost_after);
    gain_ = params.number("gain", 0.0, "dBi", "of its antenna");
    losses_.light_wall =
        params.number("light_wall_loss", losses_.light_wall, "dB",
                      "of a wall up to 12.5 cm, and of all that is not a wall or a "
                      "floor: doors, furniture, people",
                      kNotNegative);
    losses_.heavy_wall = params.number("heavy_wall_loss", losses_.heavy_wall, "dB",
                                       "of a thicker wall", kNotNegative);
    losses_.floor =
        params.number("floor_loss", losses_.floor, "dB", "of the first floor slab", kNotNegative);
    params.noise("rssi", "dB", "of a signal strength");
  }

  void read(const View& view, Hits, Rng&, Reading& reading) override {
    std::map<std::string, double> received;  // by id
    const std::vector<DeviceView> devices = view.devices("tx_power");
    if (paths_.size() > devices.size()) paths_.clear();  // some are gone
    for (const DeviceView& device : devices) {
      if (device.kind != "transmitter" || !device.state.get<bool>("on")) continue;
      const auto id = device.state.get<std::string>("id");
      const double least = sensitivity_ - (received_.count(id) > 0 ? hysteresis_ : 0.0);
      const double rssi = strength(device, least, view);
      if (rssi < least) continue;
      const auto [entry, is_new] = received.emplace(id, rssi);
      if (!is_new && rssi > entry->second) entry->second = rssi;
    }
    std::vector<std::string> ids;
    std::vector<double> strengths;
    for (const auto& [id, rssi] : received) {
      ids.push_back(id);
      strengths.push_back(rssi);
    }
    changes_.note(present({ids.begin(), ids.end()}, view.time()), reading);
    reading.set("ids", std::move(ids));
    reading.set("rssi", std::move(strengths));
  }

  Nanoseconds idle_until(const Ahead&) const override {
    return silent_since_.empty() && !changes_.pending() ? kForever : 0;
  }

 private:
  // The ids that it receives, and those that were silent for less than `lost_after`.
  std::vector<std::string> present(std::set<std::string> ids, Nanoseconds now) {
    for (const std::string& id : received_) {
      if (ids.count(id) == 0) silent_since_.emplace(id, now);
    }
    received_ = ids;
    for (auto entry = silent_since_.begin(); entry != silent_since_.end();) {
      const auto& [id, since] = *entry;
      const bool over = received_.count(id) > 0 || now - since >= lost_after_;
      if (!over) ids.insert(id);
      entry = over ? silent_since_.erase(entry) : std::next(entry);
    }
    return {ids.begin(), ids.end()};
  }

  // dBm; without obstacles if it is below `needed` anyway.
  double strength(const DeviceView& transmitter, double needed, const View& view) {
    const Vec3 from = transmitter.place();
    const Vec3 way = view.pose().position - from;
    const double distance = way.norm();
    const double loss = free_space_loss(distance, transmitter.state.get<double>("frequency"));
    const double least = transmitter.state.get<double>("tx_power") + gain_ - loss;
    if (least < needed || distance <= 2.0 * kSkin) return least;
    const Vec3 ahead = way / distance;
    const Vec3 skin = kSkin * ahead;
    const std::vector<rays::Crossing> crossings = paths_[std::string(transmitter.name)].crossings(
        view.rays(), from + skin, view.pose().position - skin);
    return least - loss_of(obstacles_on(crossings, ahead), losses_);
  }

  double sensitivity_ = 0.0;  // dBm
  double hysteresis_ = 0.0;   // dB
  Nanoseconds lost_after_ = 0;
  std::set<std::string> received_;                   // ids, at the last sample
  std::map<std::string, Nanoseconds> silent_since_;  // ids, and their first sample without them
  double gain_ = 0.0;                                // dBi
  PathLoss losses_;
  std::map<std::string, RadioPath> paths_;  // by transmitter
  IdChanges changes_{"received", "lost"};
};

ANGEN_REGISTER_SENSOR(RadioReceiver,
                      Kind("receiver", "The signal strength of the radio transmitters it receives.")
                          .rate(1.0)
                          .model("radio_receiver")
                          .example("spawn receiver r1 --pose \"1 1 1.2\" --set sensitivity=-80")
                          .texts("ids", "of the transmitters that it receives, sorted")
                          .shown()
                          .numbers("rssi", "dBm", "of these")
                          .shown(1))

}  // namespace angen::sensors

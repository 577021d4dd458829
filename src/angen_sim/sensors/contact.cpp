#include <algorithm>
#include <optional>

#include "plugin/register.h"
#include "sensors/one_draw.h"
#include "sensors/watched.h"

namespace angen::sensors {

namespace {

void append(std::vector<double>& flat, const Vec3& v) {
  flat.insert(flat.end(), {v.x(), v.y(), v.z()});
}

/// Contact pairs as the flat lists that a reading holds.
struct Lists {
  std::vector<std::string> collision1, collision2;
  std::vector<double> counts, positions, normals, depths, forces;

  void add(const ContactPair& pair, double noise_stddev, Rng& rng) {
    collision1.push_back(pair.first);
    collision2.push_back(pair.second);
    counts.push_back(static_cast<double>(pair.points.size()));
    for (const ContactPoint& point : pair.points) {
      append(positions, point.position);
      append(normals, point.normal);
      depths.push_back(point.depth);
      Vec3 force = point.force;
      if (noise_stddev > 0.0) {
        for (int axis = 0; axis < 3; ++axis) force[axis] += noise_stddev * rng.gaussian();
      }
      append(forces, force);
    }
  }
};

/// What touches; as an echo, what is read while that stays.
struct Touch : OneDraw {
  bool pressed = false;
  std::vector<ContactPair> pairs;
  double noise_stddev = 0.0;  // N

  bool has(const std::string& first, const std::string& second) const {
    return std::any_of(pairs.begin(), pairs.end(), [&](const ContactPair& pair) {
      return pair.first == first && pair.second == second;
    });
  }

  void tell(Rng rng, Reading& reading) const override {
    Lists lists;
    for (const ContactPair& pair : pairs) lists.add(pair, noise_stddev, rng);
    reading.set("pressed", pressed);
    reading.set("collision1", std::move(lists.collision1));
    reading.set("collision2", std::move(lists.collision2));
    reading.set("counts", std::move(lists.counts));
    reading.set("positions", std::move(lists.positions));
    reading.set("normals", std::move(lists.normals));
    reading.set("depths", std::move(lists.depths));
    reading.set("forces", std::move(lists.forces));
  }
};

}  // namespace

/// Everything that touches some collisions of its link, also what lies still.
class Contact : public Sensor {
 public:
  double default_rate() const override { return 1.0; }
  Nanoseconds sample_period() const override { return debounce_ > 0 ? sample_period_ : 0; }

  void configure(Params& params, Wiring& wiring) override {
    touch_.noise_stddev =
        params.number("noise_stddev", 0.0, "N", "of each component of a force", kNotNegative);
    debounce_ = from_seconds(params.number(
        "debounce", 0.0, "s", "touch and release count once they have lasted so long", {0.0, 1e6}));
    const double sample_rate = params.number("sample_rate", 100.0, "Hz",
                                             "how often it looks, given a debounce", {1e-3, 1e6});
    sample_period_ = from_seconds(1.0 / sample_rate);
    params.text("bumperTopicName", "/angen/contact/NAME", "where it publishes");
    collisions_ = read_watched(params, wiring, "a contact sensor");
  }

  void read(const View& view, Hits, Rng& rng, Reading& reading) override {
    touch_.pairs.clear();
    for (const ContactRef collision : collisions_) {
      for (ContactPair& pair : view.contacts(collision)) {
        // Two watched collisions that touch each other see the same pair from both sides.
        if (!touch_.has(pair.second, pair.first)) touch_.pairs.push_back(std::move(pair));
      }
    }
    const bool touched = !touch_.pairs.empty();
    if (settled(touched, view.time())) {
      reading.urgent = debounce_ > 0;
      reading.event = touched ? "pressed" : "released";
      if (touched) reading.event_detail = "by " + touch_.pairs.front().second;
    }
    touch_.pressed = *pressed_;
    touch_.tell(rng, reading);
  }

  Rest rest() const override {
    if (changed_at_) return Rest::kBusy;  // it waits for the end of a debounce
    return touch_.noise_stddev > 0.0 && !touch_.pairs.empty() ? Rest::kNoise : Rest::kSame;
  }
  double quiet_chance() const override { return 1.0; }  // noise neither presses nor releases
  std::shared_ptr<const Echo> echo() const override { return std::make_shared<Touch>(touch_); }

 private:
  // True when a change that began a debounce ago or earlier has lasted until now.
  bool settled(bool touched, Nanoseconds now) {
    if (!pressed_) pressed_ = touched;
    if (touched == *pressed_) {
      changed_at_.reset();
      return false;
    }
    if (!changed_at_) changed_at_ = now;
    if (now - *changed_at_ < debounce_) return false;
    changed_at_.reset();
    pressed_ = touched;
    return true;
  }

  std::vector<ContactRef> collisions_;
  Touch touch_;
  Nanoseconds debounce_ = 0;
  Nanoseconds sample_period_ = kSecond / 100;
  std::optional<bool> pressed_;            // none before the first reading
  std::optional<Nanoseconds> changed_at_;  // since when it has looked otherwise
};

ANGEN_REGISTER_SENSOR(Contact, "contact", "What touches a body: names, points, depths, forces.")

}  // namespace angen::sensors

// libmicrophone.so
#include <algorithm>
#include <cmath>
#include <optional>

#include "plugin/registration.h"
#include "plugin/rooms.h"
#include "plugin/view.h"
#include "sensors/sound_field.h"

namespace angen::sensors {

namespace {

constexpr double kWallGap = 0.5;     // m: faces of two rooms that near have a wall between them
constexpr double kHysteresis = 3.0;  // dB below the threshold it is quiet again
constexpr double kBeside = 3.0;      // m: tolerance above and below a room for sources in it

double perimeter(const Polygon& polygon) {
  double length = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    length += (polygon[(i + 1) % polygon.size()] - polygon[i]).norm();
  }
  return length;
}

/// m of the edge from a to b before which, outside of its room, the edge from c to d faces it.
double facing(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  constexpr double kParallel = 0.05;
  const Point2 along = (b - a).normalized();
  const Point2 outward(along.y(), -along.x());
  if ((d - c).normalized().dot(along) > kParallel - 1.0) return 0.0;
  const double gap = (0.5 * (c + d) - a).dot(outward);
  if (gap < 0.0 || gap > kWallGap) return 0.0;
  return std::max(0.0,
                  std::min((b - a).norm(), (c - a).dot(along)) - std::max(0.0, (d - a).dot(along)));
}

Eigen::AlignedBox2d flat_box(const Room& room) {
  Eigen::AlignedBox2d box;
  for (const Point2& corner : room.outline) box.extend(corner);
  return box;
}

/// Area (m^2) of the wall or floor between two adjacent rooms; 0 for others.
double shared_wall(const Room& a, const Room& b) {
  const double height = std::min(a.ceiling, b.ceiling) - std::max(a.floor, b.floor);
  if (height <= 0.0) {
    if (-height > kWallGap) return 0.0;
    const Eigen::AlignedBox2d both = flat_box(a).intersection(flat_box(b));
    return both.isEmpty() ? 0.0 : std::min({both.volume(), a.area, b.area});
  }
  double length = 0.0;
  for (std::size_t i = 0; i < a.outline.size(); ++i) {
    for (std::size_t k = 0; k < b.outline.size(); ++k) {
      length += facing(a.outline[i], a.outline[(i + 1) % a.outline.size()], b.outline[k],
                       b.outline[(k + 1) % b.outline.size()]);
    }
  }
  return length * height;
}

/// The layer of the world, endless to the sides, in which the rooms of a plan are.
Eigen::AlignedBox3d layer_of(const RoomPlan& plan) {
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  for (const Room* room : plan.rooms) {
    low = std::min(low, room->floor);
    high = std::max(high, room->ceiling);
  }
  return {Vec3(-HUGE_VAL, -HUGE_VAL, low - kBeside), Vec3(HUGE_VAL, HUGE_VAL, high + kBeside)};
}

double surface(const Room& room) {
  double around = perimeter(room.outline);
  for (const Polygon& hole : room.holes) around += perimeter(hole);
  return 2.0 * room.area + around * (room.ceiling - room.floor);
}

}  // namespace

/// The sound pressure level where it is, of all that sounds in its room and in the rooms around.
class Microphone : public Sensor {
 public:
  void configure(Params& params, Wiring&) override {
    absorption_ = params.number("absorption", 0.2, "", "mean coefficient of the rooms' surfaces",
                                {0.01, 0.99});
    wall_ =
        from_decibels(-params.number("wall_reduction", 38.0, "dB",
                                     "sound reduction index of walls between rooms", kNotNegative));
    leaf_ = from_decibels(-params.number("leaf_reduction", 22.0, "dB",
                                         "sound reduction index of a shut leaf and its gaps",
                                         kNotNegative));
    background_ = from_decibels(
        params.number("background", 30.0, "dB", "level where nothing sounds", {-50.0, 200.0}));
    threshold_ = params.number("threshold", 60.0, "dB", "loud above it", {-50.0, 200.0});
    params.noise("level", "dB", "of a level");
  }

  void read(const View& view, Hits, Rng&, Reading& reading) override {
    const Vec3 here = view.pose().position;
    const Hearing hearing = listen(view, here);
    double sum = background_;
    for (const DeviceView& source : view.devices("sound_power_level", hearing.within)) {
      sum += heard(view, source, here, hearing);
    }
    const double level = to_decibels(sum);
    const bool loud = level > (loud_ ? threshold_ - kHysteresis : threshold_);
    if (loud != loud_) {
      reading.announce(loud ? "loud" : "quiet");
    }
    loud_ = loud;
    reading.set("level", level);
    reading.set("loud", loud);
  }

  Nanoseconds idle_until(const Ahead&) const override { return kForever; }

 private:
  /// The room that the microphone is in, and what it has of the sound in each room of its plan; or
  /// all of the world outdoors.
  struct Hearing {
    std::optional<RoomPlan> plan;  // none outdoors
    Eigen::AlignedBox3d within;    // m: it hears nothing from elsewhere
    int here = RoomPlan::kOutside;
    std::vector<double> gains;
  };

  /// The room at a point; null outdoors, and in rooms that no climate describes.
  static const Room* room_at(const View& view, const Vec3& point) {
    const Room* room = view.home().room_at(point);
    return room != nullptr && has_climate(view, *room) ? room : nullptr;
  }

  Hearing listen(const View& view, const Vec3& here) const {
    Hearing hearing;
    const Room* room = room_at(view, here);
    if (room == nullptr) {
      hearing.within = {Vec3::Constant(-HUGE_VAL), Vec3::Constant(HUGE_VAL)};
      return hearing;
    }
    hearing.plan.emplace(room_plan(view, room->model));
    hearing.here = static_cast<int>(room->number);
    hearing.within = layer_of(*hearing.plan);
    hearing.gains = field(view, *hearing.plan, hearing.within).gains(hearing.here);
    return hearing;
  }

  SoundField field(const View& view, const RoomPlan& plan,
                   const Eigen::AlignedBox3d& within) const {
    std::vector<double> surfaces;
    for (const Room* room : plan.rooms) surfaces.push_back(surface(*room));
    SoundField field(surfaces, absorption_);
    for (std::size_t i = 0; i < plan.rooms.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        const double area = shared_wall(*plan.rooms[i], *plan.rooms[k]);
        if (area > 0.0) field.pass(static_cast<int>(i), static_cast<int>(k), area * wall_);
      }
    }
    for (const RoomOpening& opening : room_openings(view, plan, within)) {
      const double open = opening.height * opening.gap;
      const double shut = opening.height * std::max(0.0, opening.width - opening.gap);
      const bool inside =
          opening.first != RoomPlan::kOutside && opening.second != RoomPlan::kOutside;
      const double wall = inside ? (open + shut) * wall_ : 0.0;  // 0 if there is no wall
      field.pass(opening.first, opening.second, open + shut * leaf_ - wall);
    }
    return field;
  }

  // Expressed by a power whose level over 1 pW is the sound pressure level.
  static double heard(const View& view, const DeviceView& source, const Vec3& here,
                      const Hearing& hearing) {
    const Vec3 at = source.place();
    const double power = from_decibels(source.state.get<double>("sound_power_level"));
    const int room = hearing.plan ? hearing.plan->at(at) : RoomPlan::kOutside;
    const bool together = hearing.plan ? room == hearing.here : room_at(view, at) == nullptr;
    double gain = 0.0;
    if (together) {
      gain += direct_gain((at - here).norm(), source.state.get<double>("directivity", 1.0));
    }
    if (room != RoomPlan::kOutside) gain += hearing.gains[static_cast<std::size_t>(room)];
    return power * gain;
  }

  double absorption_ = 0.0;
  double wall_ = 0.0;        // share of the sound that walls let through
  double leaf_ = 0.0;        // and shut leaves
  double background_ = 0.0;  // mean square pressure, in that of 0 dB
  double threshold_ = 0.0;   // dB
  bool loud_ = false;
};

ANGEN_REGISTER_SENSOR(Microphone,
                      Kind("microphone", "The sound pressure level of sources in the rooms.")
                          .rate(2.0)
                          .model("microphone")
                          .example("spawn microphone m1 --pose \"0.1 1 1.5\" --set background=35")
                          .number("level", "dB", "sound pressure level over 20 µPa, not weighted")
                          .shown(1)
                          .flag("loud", "whether it is above the threshold")
                          .alarm("LOUD", "")
                          .events("loud", "quiet"))

}  // namespace angen::sensors

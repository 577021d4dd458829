// libroom_climate.so
#include <cmath>
#include <optional>

#include "devices/refresh.h"
#include "devices/room_air.h"
#include "plugin/registration.h"
#include "plugin/rooms.h"
#include "plugin/view.h"
#include "plugin/wiring.h"

namespace angen::devices {

namespace {

constexpr double kRate = 1.0;                // Hz: rooms take minutes
constexpr double kWall = 0.05;               // m: a thing in a wall is near the room
constexpr double kWidestLeaf = 3.0;          // m, from its hinge
constexpr double kKilogram = 1e-3 / 3600.0;  // a second, for a g/h
constexpr Range kCelsius{-60.0, 60.0};

}  // namespace

/// The air in the rooms of a model. A device that reports a `power` heats its room, by its `heat`
/// where that is another; one that reports `vapor`, such as a person, by its `heat` and vapor;
/// any device that reports a `gap` lets air through between the rooms on its two sides.
class Climate : public Device {
 public:
  void configure(Params& params, Wiring& wiring) override {
    model_ = wiring.model();
    const std::vector<Room> rooms = wiring.rooms();
    RoomAir::Settings settings;
    settings.heat_loss = params.number("heat_loss", 0.5, "W/(K m^3)",
                                       "through walls and windows, a volume", kNotNegative);
    settings.air_change =
        params.number("air_change", 0.3, "1/h", "of each room with the outside, through cracks",
                      kNotNegative) /
        3600.0;
    settings.heat_capacity = params.number(
        "heat_capacity", 1.0, "", "of a room's contents, in that of its air", {1.0, 1000.0});
    settings.heating_power =
        params.number("heating_power", 50.0, "W/m^3",
                      "of radiators that are fully open, a volume of the room", kNotNegative);
    const double heating =
        params.number("heating", std::nan(""), "degC",
                      "to which radiators heat each room; there are none unless given", kCelsius);
    Air inside;
    inside.temperature = params.number("temperature", 20.0, "degC", "at the start", kCelsius);
    inside.moisture = moisture_of(
        inside.temperature, params.number("humidity", 50.0, "%", "at the start", {0.0, 100.0}));
    outside_.temperature =
        params.number("outside_temperature", 5.0, "degC", "of the air outside", kCelsius);
    outside_humidity_ =
        params.number("outside_humidity", 80.0, "%", "of the air outside", {0.0, 100.0});
    outside_.moisture = moisture_of(outside_.temperature, outside_humidity_);
    std::vector<double> volumes;
    for (const Room& room : rooms) volumes.push_back(room.area * (room.ceiling - room.floor));
    if (rooms.empty()) {
      throw Error("model '" + model_ +
                  "' has a climate and no rooms; describe them by <angen:room>");
    }
    air_ = RoomAir(settings, std::move(volumes), inside);
    if (!std::isnan(heating)) heat_to(heating);
    const auto airs = params.rows("air", 2, "degC %",
                                  "temperature and humidity at the start, of each room in its "
                                  "order; of all as above unless given");
    if (!airs.empty() && airs.size() != rooms.size()) {
      throw params.error("air", "there are " + std::to_string(airs.size()) + " <air> and " +
                                    std::to_string(rooms.size()) +
                                    " rooms; give one for each room, or none");
    }
    for (std::size_t i = 0; i < airs.size(); ++i) {
      const double temperature = airs[i][0];
      const double humidity = airs[i][1];
      if (!(temperature >= kCelsius.min && temperature <= kCelsius.max && humidity >= 0.0 &&
            humidity <= 100.0)) {
        throw params.error("air", "an <air> is outside -60 to 60 degrees Celsius or 0 to 100 %");
      }
      air_.fill(i, {temperature, moisture_of(temperature, humidity)});
    }
  }

  Verdict command(const Command& command, const View&) override {
    return Verdict::accept([this, heats = command.verb == "Heat", temperature = command.number] {
      if (heats) {
        heat_to(temperature);
        return;
      }
      outside_.temperature = temperature;
      outside_.moisture = moisture_of(temperature, outside_humidity_);
    });
  }

  void update(const View& view, Outputs&) override {
    if (!due_.due(view.time(), view.step())) return;
    const Nanoseconds before = stepped_at_ < 0 ? view.time() : stepped_at_;
    stepped_at_ = view.time();
    const RoomPlan plan = room_plan(view, model_);
    const Eigen::AlignedBox3d around = surroundings(plan);
    std::vector<double> heat(air_.rooms().size(), 0.0);
    std::vector<double> vapor(air_.rooms().size(), 0.0);
    for (const DeviceView& device : view.devices("power", around)) {
      const int room = plan.at(device.pose.position);
      if (room == RoomPlan::kOutside) continue;
      const auto power = device.state.get<double>("power");
      heat[static_cast<std::size_t>(room)] += device.state.get<double>("heat", power);
    }
    for (const DeviceView& device : view.devices("vapor", around)) {
      const int room = plan.at(device.pose.position);
      if (room == RoomPlan::kOutside) continue;
      if (device.state.find("power") == nullptr) {
        heat[static_cast<std::size_t>(room)] += device.state.get<double>("heat");
      }
      vapor[static_cast<std::size_t>(room)] += kKilogram * device.state.get<double>("vapor");
    }
    std::vector<Opening> openings;
    for (const RoomOpening& opening : room_openings(view, plan, around)) {
      if (!(opening.gap > 0.0)) continue;
      openings.push_back({opening.first, opening.second, opening.gap, opening.height});
    }
    air_.step(to_seconds(stepped_at_ - before), outside_, heat, openings, vapor);
  }

  Nanoseconds idle_until(const View& view) const override { return due_.next(view.time()); }

  void save(SavedParams& params) const override {
    params.number("outside_temperature", outside_.temperature);
    if (heating_) {
      params.number("heating", *heating_);
    } else {
      params.unset("heating");
    }
    for (const Air& air : air_.rooms()) params.row("air", {air.temperature, humidity_of(air)});
  }

  void report(const View& view, Reading& state) const override {
    std::vector<std::string> names;
    for (const Room* room : room_plan(view, model_).rooms) names.push_back(room->name);
    std::vector<double> temperatures;
    std::vector<double> humidities;
    for (const Air& air : air_.rooms()) {
      temperatures.push_back(air.temperature);
      humidities.push_back(humidity_of(air));
    }
    state.set("names", std::move(names));
    state.set("temperatures", std::move(temperatures));
    state.set("humidities", std::move(humidities));
    state.set("outside_temperature", outside_.temperature);
    state.set("outside_humidity", outside_humidity_);
    if (heating_) state.set("heating", *heating_);
  }

 private:
  void heat_to(double temperature) {
    heating_ = temperature;
    air_.heat_to(temperature);
  }

  // The region of models that affect a room, hinges of leaves beside it included.
  static Eigen::AlignedBox3d surroundings(const RoomPlan& plan) {
    const Vec3 margin(kWidestLeaf, kWidestLeaf, kWall);
    Eigen::AlignedBox3d around;
    for (const Room* room : plan.rooms) {
      for (const Point2& corner : room->outline) {
        around.extend(Vec3(corner.x(), corner.y(), room->floor));
        around.extend(Vec3(corner.x(), corner.y(), room->ceiling));
      }
    }
    return {Vec3(around.min() - margin), Vec3(around.max() + margin)};
  }

  std::string model_;
  RoomAir air_;
  Air outside_;
  double outside_humidity_ = 0.0;  // percent
  std::optional<double> heating_;  // degrees Celsius, none without radiators
  Nanoseconds stepped_at_ = -1;
  Refresh due_{kRate};
};

ANGEN_REGISTER_DEVICE(
    Climate,
    Kind("climate", "The air in a model's rooms.")
        .group("")
        .verb("Outside", "degrees", "°C", kCelsius, "temperature of the air outdoors")
        .verb("Heat", "degrees", "°C", kCelsius, "to which radiators heat each room")
        .texts("names", "of each room")
        .numbers("temperatures", "°C", "of each room")
        .shown_by_name("names", 1)
        .numbers("humidities", "%", "of each room, relative")
        .number("outside_temperature", "°C", "outdoors")
        .number("outside_humidity", "%", "outdoors, relative")
        .number("heating", "°C", "to which radiators heat each room; none without radiators"))

}  // namespace angen::devices

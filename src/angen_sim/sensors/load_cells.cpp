// libload_cells.so
#include <algorithm>
#include <cmath>
#include <limits>

#include "plugin/registration.h"
#include "plugin/view.h"
#include "sensors/watched.h"

namespace angen::sensors {

namespace {

struct Cell {
  double load = 0.0;  // kg
  double x = 0.0;     // m, where it presses, in the sensor's frame
  double y = 0.0;
};

/// The cells while their loads stay: the sum less the tare, and its center.
struct Scale : LazyReading {
  double tare = 0.0;    // kg
  double tare_x = 0.0;  // m
  double tare_y = 0.0;  // m
  double least = 0.0;   // kg that have a place
  double stddev = 0.0;  // kg, of each cell's noise
  std::vector<Cell> cells;

  double weight() const {
    double sum = -tare;
    for (const Cell& cell : cells) sum += cell.load;
    return sum;
  }

  void read(Nanoseconds, const Draws& draws, Reading& reading) const override {
    write(draws(0), reading);
  }

  void write(Rng rng, Reading& reading) const {
    double sum = -tare;
    double x = -tare * tare_x;
    double y = -tare * tare_y;
    std::vector<double> loads;
    for (const Cell& cell : cells) {
      loads.push_back(cell.load + stddev * rng.gaussian());
      sum += loads.back();
      x += loads.back() * cell.x;
      y += loads.back() * cell.y;
    }
    const bool says = sum >= least;
    const double none = std::numeric_limits<double>::quiet_NaN();
    reading.set("weight", sum);
    reading.set("x", says ? x / sum : none);
    reading.set("y", says ? y / sum : none);
    reading.set("cells", std::move(loads));
  }
};

}  // namespace

/// Load cells under the feet of a table: each weighs the load of its foot. Together
/// they give the weight on the table, and its center.
class LoadCells : public Sensor {
 public:
  void configure(Params& params, Wiring& wiring) override {
    scale_.tare =
        params.number("tare", 0.0, "kg", "of the table itself, which is subtracted", kNotNegative);
    const std::vector<double> place =
        params.row("tare_place", {0.0, 0.0}, "m", "x y of its center");
    scale_.tare_x = place[0];
    scale_.tare_y = place[1];
    scale_.least = params.number(
        "least", 0.05, "kg", "a smaller weight has no place: x and y are not numbers", kPositive);
    step_ = params.number("event_step", 0.1, "kg", "a change by more is an event", kPositive);
    capacity_ = params.number("capacity", 50.0, "kg", "of each cell; it shows no more", kPositive);
    scale_.stddev = params.number("noise_stddev", 0.0, "kg", "of each cell", kNotNegative);
    sample_period_ = read_sample_period(params, 10.0);
    collisions_ = read_watched(params, wiring, "a set of load cells");
  }

  void read(const View& view, Hits, Rng& rng, Reading& reading) override {
    scale_.cells.clear();
    for (const ContactRef collision : collisions_) scale_.cells.push_back(cell(view, collision));
    note_change(scale_.weight(), reading);
    scale_.write(rng, reading);
  }

  // Events are of the loads before noise.
  Nanoseconds idle_until(const Ahead&) const override { return settled_ ? kForever : 0; }
  std::shared_ptr<const LazyReading> lazy_reading() const override {
    if (scale_.stddev == 0.0) return nullptr;
    return std::make_shared<Scale>(scale_);
  }

 private:
  Cell cell(const View& view, ContactRef collision) const {
    const Pose here = view.pose();
    const Vec3 up = here.rotation * Vec3::UnitZ();
    Cell found;
    double force = 0.0;
    for (const ContactPair& pair : view.contacts(collision)) {
      for (const ContactPoint& point : pair.points) {
        const double pressed = point.force.dot(up);
        const Vec3 at = here.inverse() * point.position;
        force += pressed;
        found.x += pressed * at.x();
        found.y += pressed * at.y();
      }
    }
    if (force <= 0.0) return {};
    return {std::min(force / view.gravity().norm(), capacity_), found.x / force, found.y / force};
  }

  // A thing that is put down swings for a moment: a change counts once two samples agree.
  void note_change(double weight, Reading& reading) {
    settled_ = std::abs(weight - last_) < 0.1 * step_;
    last_ = weight;
    if (!settled_ || std::abs(weight - told_) < step_) return;
    if (has_told_) {
      reading.announce(weight > told_ ? "placed" : "removed",
                       std::to_string(std::lround(1000.0 * (weight - told_))) + " g");
    }
    has_told_ = true;
    told_ = weight;
  }

  std::vector<ContactRef> collisions_;
  Scale scale_;
  double step_ = 0.0;                                      // kg
  double capacity_ = 0.0;                                  // kg
  double last_ = std::numeric_limits<double>::infinity();  // kg
  double told_ = std::numeric_limits<double>::infinity();  // kg, at the last event
  bool has_told_ = false;
  bool settled_ = false;
};

ANGEN_REGISTER_SENSOR(
    LoadCells, Kind("load_cells", "Load cells under a table: the weight on it, and its center.")
                   .rate(10.0)
                   .sensor_type("contact")
                   .example("spawn load_cells l1 --on kitchen_table0::body --set tare=20")
                   .number("weight", "kg", "on the table, without the tare")
                   .shown(2)
                   .number("x", "m", "of its center, in the sensor's frame; NaN without a weight")
                   .shown(2)
                   .number("y", "m", "of its center, in the sensor's frame")
                   .shown(2)
                   .numbers("cells", "kg", "of each cell"))

}  // namespace angen::sensors

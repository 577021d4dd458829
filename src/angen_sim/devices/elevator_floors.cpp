#include "devices/elevator_floors.h"

#include "plugin/wiring.h"

namespace angen::devices {

namespace {

constexpr std::size_t kMaxFloors = 1000;
constexpr std::size_t kFewestFloors = 2;

std::vector<double> read_stops(Params& params) {
  std::vector<double> heights;
  for (const std::vector<double>& stop :
       params.rows("stop", 1, "m",
                   "height of a floor over floor 0, one for each floor from below; "
                   "instead of floor_height and floors")) {
    const bool fits = heights.empty() ? stop.front() == 0.0 : stop.front() > heights.back();
    if (!fits || heights.size() >= kMaxFloors) {
      throw params.error("stop", "the <stop> of floor " + std::to_string(heights.size()) +
                                     (heights.empty() ? " must be 0"
                                                      : " must be above the one before it; at "
                                                        "most 1000 are served"));
    }
    heights.push_back(stop.front());
  }
  return heights;
}

}  // namespace

std::vector<double> read_floors(Params& params, const Wiring& wiring, const JointLimits& limits,
                                const std::string& joint) {
  const double apart = params.number("floor_height", 0.0, "m",
                                     "from one floor to the next; 0: by the storeys of the world, "
                                     "or else evenly over the joint's travel",
                                     kNotNegative);
  const auto given = static_cast<std::size_t>(params.integer(
      "floors", 0, "", "number of floors; 0: the storeys within the joint's travel, or else 2",
      {0, static_cast<int>(kMaxFloors)}));
  std::vector<double> heights = read_stops(params);
  if (!heights.empty()) return heights;
  const std::size_t count = given > 0 ? given : kFewestFloors;
  const auto spread = [&](double height) {
    for (std::size_t floor = 0; floor < count; ++floor) {
      heights.push_back(static_cast<double>(floor) * height);
    }
    return heights;
  };
  if (apart > 0.0 || count == 1) return spread(apart);
  const bool ends = limits.lower < limits.upper && limits.upper < kUnlimited;
  for (const double floor : wiring.floors()) {
    const bool reached = !ends || floor <= limits.upper + kLevelWithin;
    if (reached && (given == 0 || heights.size() < given)) heights.push_back(floor);
  }
  if (heights.size() >= count) return heights;
  heights.clear();
  if (ends) return spread(limits.upper / static_cast<double>(count - 1));
  throw params.error("floor_height", "the world has no " + std::to_string(count) +
                                         " storeys, and the joint " + joint +
                                         " no end; give a <floor_height>, or a <stop> of each "
                                         "floor");
}

}  // namespace angen::devices

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "core/limits.h"
#include "core/text.h"
#include "document/values.h"
#include "document/xml.h"
#include "import/urdf.h"
#include "sdf/check.h"
#include "sdf/describe.h"

namespace angen::load {

namespace {

enum class Want { kAny, kPositive, kNotNegative, kFlag, kDirection };

struct Rule {
  std::size_t least;  // how many numbers
  std::size_t most;
  Want want = Want::kAny;
  Limit limit = limits::kOther;
};

using Key = std::pair<std::string, std::string>;  // parent ("" = any), element

constexpr Rule kOne{1, 1};
constexpr Rule kColor{3, 4, Want::kNotNegative, limits::kColor};
constexpr Rule kPositive{1, 1, Want::kPositive};
constexpr Rule kNotNegative{1, 1, Want::kNotNegative};
constexpr Rule kFlag{0, 0, Want::kFlag};
constexpr Rule kLength{1, 1, Want::kPositive, limits::kLength};
constexpr Rule kDirection{3, 3, Want::kDirection, limits::kDirection};
constexpr Rule kAngle{1, 1, Want::kAny, limits::kAngle};
constexpr Rule kNoLimit{1, 1, Want::kAny, limits::kNoLimit};
constexpr Limit kFinite{"", std::numeric_limits<double>::max(), 0.0};
constexpr Rule kAnyNumber{1, 1, Want::kAny, kFinite};  // a large one is no limit, or no sliding
constexpr Rule kAnyNotNegative{1, 1, Want::kNotNegative, kFinite};

// What tunes the solver: a number beyond these has the same effect as the bound itself, as far as
// the solver can tell, so it is replaced, with a warning.
struct Bounds {
  double low;
  double high;
};

const std::map<Key, Bounds>& solver_bounds() {
  static const std::map<Key, Bounds> table = {
      {{"ode", "kp"}, {1e-6, 1e16}},
      {{"ode", "kd"}, {0.0, 1e16}},
      {{"ode", "min_depth"}, {0.0, 1.0}},
      {{"ode", "slip1"}, {0.0, 1e9}},
      {{"ode", "slip2"}, {0.0, 1e9}},
      {{"bounce", "restitution_coefficient"}, {0.0, 1.0}},
      {{"dynamics", "damping"}, {1e-9, 1e12}},
      {{"dynamics", "friction"}, {0.0, 1e12}},
      {{"solver", "iters"}, {1.0, 1e4}},
      {{"constraints", "cfm"}, {0.0, 1e6}},
      {{"constraints", "erp"}, {0.0, 1.0}},
      {{"constraints", "contact_max_correcting_vel"}, {0.0, limits::kSpeed.most}},
      {{"constraints", "contact_surface_layer"}, {0.0, 1.0}},
  };
  return table;
}

const std::map<Key, Rule>& rules() {
  static const std::map<Key, Rule> table = {
      {{"box", "size"}, {3, 3, Want::kPositive, limits::kLength}},
      {{"plane", "size"}, {2, 2, Want::kPositive, limits::kNoLimit}},
      {{"plane", "normal"}, kDirection},
      {{"heightmap", "size"}, {3, 3, Want::kPositive, limits::kLength}},
      {{"heightmap", "pos"}, {3, 3, Want::kAny, limits::kPosition}},
      {{"mesh", "scale"}, {3, 3, Want::kAny, limits::kScale}},
      {{"submesh", "center"}, kFlag},
      {{"sphere", "radius"}, kLength},
      {{"cylinder", "radius"}, kLength},
      {{"cylinder", "length"}, kLength},
      {{"capsule", "radius"}, kLength},
      {{"capsule", "length"}, kLength},
      {{"axis", "xyz"}, kDirection},
      {{"axis2", "xyz"}, kDirection},
      {{"axis", "initial_position"}, {1, 1, Want::kAny, limits::kPosition}},
      {{"axis2", "initial_position"}, {1, 1, Want::kAny, limits::kPosition}},
      {{kSafety, "soft_lower_limit"}, kNoLimit},
      {{kSafety, "soft_upper_limit"}, kNoLimit},
      {{kSafety, "k_position"}, kNotNegative},
      {{kSafety, "k_velocity"}, kNotNegative},
      {{"limit", "effort"}, kAnyNumber},
      {{"limit", "velocity"}, kAnyNumber},
      {{"dynamics", "damping"}, kNotNegative},
      {{"dynamics", "friction"}, kNotNegative},
      {{"dynamics", "spring_stiffness"}, kNotNegative},
      {{"dynamics", "spring_reference"}, kNoLimit},
      {{"ode", "mu"}, kAnyNotNegative},
      {{"ode", "mu2"}, kAnyNotNegative},
      {{"ode", "fdir1"}, {3, 3, Want::kAny, limits::kDirection}},
      {{"ode", "slip1"}, kNotNegative},
      {{"ode", "slip2"}, kNotNegative},
      {{"ode", "kp"}, kPositive},
      {{"ode", "kd"}, kNotNegative},
      {{"ode", "min_depth"}, kNotNegative},
      {{"bounce", "restitution_coefficient"}, kNotNegative},
      {{"material", "ambient"}, kColor},
      {{"material", "diffuse"}, kColor},
      {{"material", "specular"}, kColor},
      {{"material", "emissive"}, kColor},
      {{"visual", "transparency"}, kNotNegative},
      {{"light", "diffuse"}, kColor},
      {{"light", "specular"}, kColor},
      {{"light", "direction"}, kDirection},
      {{"light", "intensity"}, {1, 1, Want::kNotNegative, limits::kIntensity}},
      {{"light", "cast_shadows"}, kFlag},
      {{"light", "angen:rectangle"}, {2, 2, Want::kPositive, limits::kLength}},
      {{"light", "angen:disc"}, kLength},
      {{"light", "angen:sphere"}, kLength},
      {{"light", "angen:tube"}, {2, 2, Want::kPositive, limits::kLength}},
      {{"light", "angen:half_angle"}, {1, 1, Want::kPositive, limits::kAngle}},
      {{"light", "angen:color_temperature"}, kPositive},
      {{"light", "angen:level"}, {1, 1, Want::kNotNegative, {"%", 100.0, 0.0}}},
      {{"attenuation", "range"}, kPositive},
      {{"attenuation", "constant"}, kNotNegative},
      {{"attenuation", "linear"}, kNotNegative},
      {{"attenuation", "quadratic"}, kNotNegative},
      {{"spot", "inner_angle"}, {1, 1, Want::kNotNegative, limits::kAngle}},
      {{"spot", "outer_angle"}, {1, 1, Want::kNotNegative, limits::kAngle}},
      {{"spot", "falloff"}, kNotNegative},
      {{"scene", "ambient"}, kColor},
      {{"scene", "background"}, kColor},
      {{"scene", "shadows"}, kFlag},
      {{"world", "gravity"}, {3, 3, Want::kAny, limits::kGravity}},
      {{"atmosphere", "temperature"}, {1, 1, Want::kPositive, limits::kTemperature}},
      {{"link", "gravity"}, kFlag},
      {{"link", "kinematic"}, kFlag},
      {{"link", "self_collide"}, kFlag},
      {{"model", "static"}, kFlag},
      {{"include", "static"}, kFlag},
      {{"model", "self_collide"}, kFlag},
      {{"model", "allow_auto_disable"}, kFlag},
      {{"physics", "max_step_size"}, {1, 1, Want::kPositive, {"s", 1.0, 1e-9}}},
      {{"physics", "real_time_factor"}, {1, 1, Want::kNotNegative, {"", 1e6}}},
      {{"physics", "real_time_update_rate"}, kNotNegative},
      {{"solver", "iters"}, kPositive},
      {{"constraints", "cfm"}, kNotNegative},
      {{"constraints", "erp"}, kNotNegative},
      {{"constraints", "contact_max_correcting_vel"}, kNotNegative},
      {{"constraints", "contact_surface_layer"}, kNotNegative},
      {{"sensor", "update_rate"}, kNotNegative},
      {{"sensor", "visualize"}, kFlag},
      {{"sensor", "always_on"}, kFlag},
      {{"horizontal", "samples"}, kPositive},
      {{"vertical", "samples"}, kPositive},
      {{"horizontal", "min_angle"}, kOne},
      {{"horizontal", "max_angle"}, kOne},
      {{"vertical", "min_angle"}, kOne},
      {{"vertical", "max_angle"}, kOne},
      {{"range", "min"}, kNotNegative},
      {{"range", "max"}, kNotNegative},
      {{"range", "resolution"}, kNotNegative},
      {{"noise", "mean"}, kOne},
      {{"noise", "stddev"}, kNotNegative},
      {{"camera", "horizontal_fov"}, kPositive},
      {{"image", "width"}, kPositive},
      {{"image", "height"}, kPositive},
      {{"image", "scale"}, kPositive},
      {{"image", "threshold"}, kNotNegative},
      {{"image", "granularity"}, kPositive},
      {{"clip", "near"}, kPositive},
      {{"clip", "far"}, kPositive},
      {{"waypoint", "time"}, {1, 1, Want::kNotNegative, limits::kTime}},
      {{"script", "delay_start"}, {1, 1, Want::kNotNegative, limits::kTime}},
      {{"script", "loop"}, kFlag},
      {{"script", "auto_start"}, kFlag},
  };
  return table;
}

double length_of(const std::vector<double>& v) {
  return std::sqrt(std::inner_product(v.begin(), v.end(), v.begin(), 0.0));
}

[[noreturn]] void refuse_number(const Element& element, double value, const std::string& right,
                                const Limit& limit = limits::kOther) {
  const std::string unit = *limit.unit == '\0' ? "" : std::string(" ") + limit.unit;
  throw Error(element.source,
              "<" + element.name + "> is " + number_text(value) + unit + "; " + right);
}

void check_rule(const Element& element, const Rule& rule, bool clamped) {
  if (rule.want == Want::kFlag) {
    flag_of(element);
    return;
  }
  const std::size_t count = numbers_in(element.text).values.size();
  const std::vector<double> values = numbers_of(element, std::clamp(count, rule.least, rule.most));
  const bool positive = rule.want == Want::kPositive;
  for (const double value : values) {
    if (positive && !(value > 0.0)) refuse_number(element, value, "it must be greater than 0");
    if (rule.want == Want::kNotNegative && value < 0.0) {
      refuse_number(element, value, "it must not be negative");
    }
    if (clamped) continue;
    const std::string problem = limit_problem(rule.limit, value, positive);
    if (!problem.empty()) refuse_number(element, value, problem, rule.limit);
  }
  // A zero vector has a meaning of its own in some places.
  const double length = rule.want == Want::kDirection ? length_of(values) : 0.0;
  const bool zero = std::all_of(values.begin(), values.end(), [](double v) { return v == 0.0; });
  if (rule.want == Want::kDirection && !zero && length < rule.limit.least) {
    throw Error(element.source, "<" + element.name + "> has length " + number_text(length) +
                                    "; give a direction such as 0 0 1");
  }
}

// What has no thickness is as thin as Gazebo makes it, as a plate of 0.3 0.2 0 m.
void set_minimum_thickness(const std::string& shape, Element& element, Session& session) {
  static const std::set<std::string> shapes = {"box", "sphere", "cylinder", "capsule"};
  if (!session.tolerant || shapes.count(shape) == 0) return;
  constexpr double kThin = 1e-4;  // m
  Numbers found = numbers_in(element.text);
  std::vector<double>& values = found.values;
  if (!found.bad.empty() || std::find(values.begin(), values.end(), 0.0) == values.end()) return;
  std::replace(values.begin(), values.end(), 0.0, kThin);
  session.warn_or_throw(
      Error(element.source,
            "<" + element.name + "> is 0; it must be greater than 0; it is taken as 0.1 mm"));
  element.text.clear();
  for (const double value : values) element.text += number_text(value) + " ";
}

// What was thrown far out of a world that somebody saved.
void clamp_pose(Element& pose, Session& session) {
  constexpr double kMax = limits::kPosition.most;
  Numbers found = numbers_in(pose.text);
  if (!session.tolerant || !found.bad.empty() || found.values.size() != 6) return;
  std::string text;
  bool far = false;
  for (std::size_t i = 0; i < found.values.size(); ++i) {
    const double value = found.values[i];
    const bool beyond = i < 3 && std::isfinite(value) && std::abs(value) > kMax;
    far = far || beyond;
    text += number_text(beyond ? std::copysign(kMax, value) : value) + " ";
  }
  if (!far) return;
  session.warn_or_throw(
      Error(pose.source, "<pose> is beyond " + number_text(kMax) +
                             " m, the farthest that anything can stand; it is taken " + "as that"));
  pose.text = text;
}

void clamp_to(const Bounds& bounds, Element& element, Session& session) {
  const double value = number_of(element);
  const double kept = value == 0.0 ? 0.0 : std::clamp(value, bounds.low, bounds.high);
  if (kept == value) return;
  session.warn(element.source, "<" + element.name + "> is " + number_text(value) +
                                   "; it is taken as " + number_text(kept) +
                                   (kept < value ? ", the most" : ", the least") +
                                   " that the solver can use");
  element.text = number_text(kept);
}

// A limit may also be infinite, but nothing can stand beyond where positions end.
void check_limit(const Element& element) {
  const Numbers found = numbers_in(element.text);
  if (!found.bad.empty() || found.values.size() != 1 || std::isnan(found.values[0])) {
    numbers_of(element, 1);
  }
  const double value = found.values[0];
  const double inward = element.name == "lower" ? value : -value;
  if (inward <= limits::kPosition.most) return;
  refuse_number(element, value,
                element.name == "lower"
                    ? "it must be at most " + number_text(limits::kPosition.most)
                    : "it must be at least " + number_text(-limits::kPosition.most));
}

}  // namespace

void check_values(Element& element, Session& session) {
  for (Element& child : element.children) {
    if (child.name == "plugin" || child.name == "state" || child.name == "gui") continue;
    if (child.name == "pose") {
      clamp_pose(child, session);
      pose_of(child);
    } else if (element.name == "limit" && (child.name == "lower" || child.name == "upper")) {
      check_limit(child);
    } else if (child.children.empty()) {
      const auto rule = rules().find({element.name, child.name});
      const auto bounds = solver_bounds().find({element.name, child.name});
      const bool clamped = bounds != solver_bounds().end();
      if (rule != rules().end()) set_minimum_thickness(element.name, child, session);
      if (rule != rules().end()) check_rule(child, rule->second, clamped);
      if (clamped) clamp_to(bounds->second, child, session);
    }
    check_values(child, session);
  }
}

}  // namespace angen::load

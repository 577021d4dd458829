#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/text.h"
#include "load/check.h"
#include "load/describe.h"
#include "load/values.h"
#include "load/xml.h"

namespace angen::load {

namespace {

enum class Want { kAny, kPositive, kNotNegative, kFlag };

struct Rule {
  std::size_t least;  // how many numbers
  std::size_t most;
  Want want = Want::kAny;
};

using Key = std::pair<std::string, std::string>;  // parent ("" = any), element

constexpr Rule kOne{1, 1};
constexpr Rule kThree{3, 3};
constexpr Rule kColor{3, 4, Want::kNotNegative};
constexpr Rule kPositive{1, 1, Want::kPositive};
constexpr Rule kNotNegative{1, 1, Want::kNotNegative};
constexpr Rule kFlag{0, 0, Want::kFlag};

const std::map<Key, Rule>& rules() {
  static const std::map<Key, Rule> table = {
      {{"box", "size"}, {3, 3, Want::kPositive}},
      {{"plane", "size"}, {2, 2, Want::kPositive}},
      {{"plane", "normal"}, kThree},
      {{"heightmap", "size"}, {3, 3, Want::kPositive}},
      {{"heightmap", "pos"}, kThree},
      {{"mesh", "scale"}, kThree},
      {{"sphere", "radius"}, kPositive},
      {{"cylinder", "radius"}, kPositive},
      {{"cylinder", "length"}, kPositive},
      {{"capsule", "radius"}, kPositive},
      {{"capsule", "length"}, kPositive},
      {{"axis", "xyz"}, kThree},
      {{"axis2", "xyz"}, kThree},
      {{"axis", "initial_position"}, kOne},
      {{"axis2", "initial_position"}, kOne},
      {{kSafety, "soft_lower_limit"}, kOne},
      {{kSafety, "soft_upper_limit"}, kOne},
      {{kSafety, "k_position"}, kNotNegative},
      {{kSafety, "k_velocity"}, kNotNegative},
      {{"limit", "effort"}, kOne},
      {{"limit", "velocity"}, kOne},
      {{"dynamics", "damping"}, kNotNegative},
      {{"dynamics", "friction"}, kNotNegative},
      {{"dynamics", "spring_stiffness"}, kNotNegative},
      {{"dynamics", "spring_reference"}, kOne},
      {{"ode", "mu"}, kNotNegative},
      {{"ode", "mu2"}, kNotNegative},
      {{"ode", "fdir1"}, kThree},
      {{"ode", "slip1"}, kNotNegative},
      {{"ode", "slip2"}, kNotNegative},
      {{"ode", "kp"}, kPositive},
      {{"ode", "kd"}, kNotNegative},
      {{"bounce", "restitution_coefficient"}, kNotNegative},
      {{"material", "ambient"}, kColor},
      {{"material", "diffuse"}, kColor},
      {{"material", "specular"}, kColor},
      {{"material", "emissive"}, kColor},
      {{"visual", "transparency"}, kNotNegative},
      {{"light", "diffuse"}, kColor},
      {{"light", "specular"}, kColor},
      {{"light", "direction"}, kThree},
      {{"light", "intensity"}, kNotNegative},
      {{"light", "cast_shadows"}, kFlag},
      {{"light", "angen:rectangle"}, {2, 2, Want::kPositive}},
      {{"light", "angen:disc"}, kPositive},
      {{"attenuation", "range"}, kPositive},
      {{"attenuation", "constant"}, kNotNegative},
      {{"attenuation", "linear"}, kNotNegative},
      {{"attenuation", "quadratic"}, kNotNegative},
      {{"spot", "inner_angle"}, kNotNegative},
      {{"spot", "outer_angle"}, kNotNegative},
      {{"spot", "falloff"}, kNotNegative},
      {{"scene", "ambient"}, kColor},
      {{"scene", "background"}, kColor},
      {{"scene", "shadows"}, kFlag},
      {{"world", "gravity"}, kThree},
      {{"atmosphere", "temperature"}, kPositive},
      {{"link", "gravity"}, kFlag},
      {{"link", "kinematic"}, kFlag},
      {{"link", "self_collide"}, kFlag},
      {{"model", "static"}, kFlag},
      {{"include", "static"}, kFlag},
      {{"model", "self_collide"}, kFlag},
      {{"model", "allow_auto_disable"}, kFlag},
      {{"physics", "max_step_size"}, kPositive},
      {{"physics", "real_time_factor"}, kNotNegative},
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
      {{"waypoint", "time"}, kNotNegative},
      {{"script", "delay_start"}, kNotNegative},
      {{"script", "loop"}, kFlag},
      {{"script", "auto_start"}, kFlag},
  };
  return table;
}

void check_rule(const Element& element, const Rule& rule) {
  if (rule.want == Want::kFlag) {
    flag_of(element);
    return;
  }
  const std::size_t count = numbers_in(element.text).values.size();
  const std::vector<double> values = numbers_of(element, std::clamp(count, rule.least, rule.most));
  for (const double value : values) {
    if (rule.want == Want::kPositive && !(value > 0.0)) {
      throw Error(element.source, "<" + element.name + "> is " + number_text(value) +
                                      "; it must be greater than 0");
    }
    if (rule.want == Want::kNotNegative && value < 0.0) {
      throw Error(element.source,
                  "<" + element.name + "> is " + number_text(value) + "; it must not be negative");
    }
  }
}

// A limit may also be infinite.
void check_limit(const Element& element) {
  const Numbers found = numbers_in(element.text);
  if (found.bad.empty() && found.values.size() == 1 && !std::isnan(found.values[0])) return;
  numbers_of(element, 1);
}

}  // namespace

void check_values(const Element& element) {
  for (const Element& child : element.children) {
    if (child.name == "plugin" || child.name == "state" || child.name == "gui") continue;
    if (child.name == "pose") {
      pose_of(child);
    } else if (element.name == "limit" && (child.name == "lower" || child.name == "upper")) {
      check_limit(child);
    } else if (child.children.empty()) {
      const auto rule = rules().find({element.name, child.name});
      if (rule != rules().end()) check_rule(child, rule->second);
    }
    check_values(child);
  }
}

}  // namespace angen::load

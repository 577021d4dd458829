#include "robots/base.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/text.h"
#include "plugin/view.h"
#include "plugin/wiring.h"

namespace angen::robots {

constexpr double kExact = 1e-6;  // rad; a covariance of zeros says that it is not known
constexpr Nanoseconds kLongestSample = kSecond / 100;  // in which it may turn
constexpr Nanoseconds kTries = 100;

std::vector<ContactRef> own_collisions(Wiring& wiring) {
  std::vector<ContactRef> collisions;
  for (const std::string& name : wiring.collision_names()) {
    collisions.push_back(wiring.collision(name));
  }
  return collisions;
}

std::vector<double> numbers(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

std::vector<double> numbers(const Quat& q) { return {q.x(), q.y(), q.z(), q.w()}; }

Topics read_topics(Params& params) {
  params.text("commandTopic", "cmd_vel", "where commands come from, below robotNamespace");
  params.text("odometryTopic", "odom", "of its odometry, below robotNamespace");
  params.text("rosDebugLevel", "", "not used: the node's log level is set by ROS");
  Topics topics;
  topics.odometry_frame = params.text("odometryFrame", "odom", "frame of its odometry");
  topics.base_frame = params.text("robotBaseFrame", "base_footprint", "frame that it moves");
  return topics;
}

void Base::configure(Params& params, Wiring& wiring) {
  topics_ = read_topics(params);
  link_ = wiring.link("");
}

void Base::read(const Pose& pose, const Vec3& velocity, double yaw_rate, Reading& reading) const {
  const double yaw = to_rpy(pose.rotation).z();
  reading.set("position", numbers(pose.position));
  reading.set("orientation", numbers(pose.rotation));
  reading.set("forward", std::cos(yaw) * velocity.x() + std::sin(yaw) * velocity.y());
  reading.set("left", std::cos(yaw) * velocity.y() - std::sin(yaw) * velocity.x());
  reading.set("turn", yaw_rate);
  reading.set("covariance", std::vector<double>(9, 0.0));
  reading.set("frame", topics_.odometry_frame);
  reading.set("base_frame", topics_.base_frame);
}

void Base::read_true(const View& view, Reading& reading) {
  const LinkView link = view.link(link_);
  rests_ = link.linear_velocity.isZero(0.0) && link.angular_velocity.isZero(0.0);
  read(link.pose, link.linear_velocity, link.angular_velocity.z(), reading);
}

Kind odometry_kind(std::string name, std::string doc, double rate) {
  return Kind(std::move(name), std::move(doc))
      .rate(rate)
      .numbers("position", "m", "x y z of the base in the odometry frame")
      .shown(2)
      .numbers("orientation", "", "quaternion x y z w")
      .number("forward", "m/s", "along the base")
      .shown(2)
      .number("left", "m/s", "across it")
      .number("turn", "rad/s", "to the left")
      .shown(2)
      .numbers("covariance", "", "of x, y (m) and yaw (rad), row by row; of the truth 0")
      .text("frame", "that the odometry starts in")
      .text("base_frame", "that it moves");
}

LinkView own_state(const View& view, LinkRef link) {
  LinkView state = view.link(link);
  const Pose pose = view.pose();
  state.linear_velocity += state.angular_velocity.cross(pose.position - state.pose.position);
  state.pose = pose;
  return state;
}

void Inertia::read(const View& view, Reading& reading) {
  const LinkView own = own_state(view, link_);
  // While it slept or had no subscribers it had no samples: then this one counts as rest.
  const Nanoseconds longest = kSecond;
  const bool follows = time_ >= 0 && view.time() > time_ && view.time() - time_ <= longest;
  if (!follows || !own.awake) motion_.forget();
  motion_.note(own.pose, own.linear_velocity, to_seconds(view.time() - time_));
  rests_ = motion_.acceleration().isZero(0.0) && own.angular_velocity.isZero(0.0);
  time_ = view.time();
  const Quat to_own = own.pose.rotation.conjugate();
  reading.set("orientation", numbers(own.pose.rotation));
  reading.set("angular_velocity", numbers(to_own * own.angular_velocity));
  reading.set("acceleration", numbers(motion_.felt(view.gravity())));
}

Kind inertia_kind(std::string name, std::string doc, double rate) {
  return Kind(std::move(name), std::move(doc))
      .rate(rate)
      .on_demand()
      .numbers("orientation", "", "in the world, quaternion x y z w")
      .numbers("angular_velocity", "rad/s", "about its x, y, z")
      .shown(2)
      .numbers("acceleration", "m/s^2", "along its x, y, z; at rest g upwards")
      .shown(2)
      .numbers("variances", "", "of orientation (rad^2), turning and acceleration, about x, y, z");
}

void InertialUnit::configure(Params& params, Wiring& wiring) {
  const double stddev = read_noise(params, {"angular_velocity", "acceleration"});
  const Vec3 all = Vec3::Constant(stddev);
  set_deviations(Vec3::Constant(kExact), all, all);
  inertia_.configure(wiring.link(""));
  // In whole parts of its period, so that it publishes at the same ticks as without.
  const Nanoseconds period = params.update_period();
  const Nanoseconds least = (period + kLongestSample - 1) / kLongestSample;
  for (Nanoseconds parts = std::max<Nanoseconds>(least, 1); parts < least + kTries; ++parts) {
    if (period % parts != 0) continue;
    sample_period_ = period / parts;
    break;
  }
}

void InertialUnit::set_deviations(const Vec3& orientation, const Vec3& turning,
                                  const Vec3& acceleration) {
  variances_.clear();
  for (const Vec3& each : {orientation, turning, acceleration}) {
    for (int axis = 0; axis < 3; ++axis) variances_.push_back(each[axis] * each[axis]);
  }
}

double read_noise(Params& params, std::initializer_list<const char*> fields) {
  Noise noise;
  noise.stddev =
      params.number("gaussianNoise", 0.0, "", "standard deviation of each number", kNotNegative);
  for (const char* field : fields) {
    noise.field = field;
    params.noise(noise);
  }
  return noise.stddev;
}

Vec3 three_numbers(Params& params, const char* path, const std::string& unit, const char* doc) {
  const std::string text = params.text(path, "0", doc + (" (" + unit + ", 1 or 3 numbers)"));
  std::vector<double> values;
  for (const std::string& word : words_in(text)) {
    const std::optional<double> value = parse_finite(word);
    if (!value || *value < 0.0) {
      throw params.error(
          path, "<" + std::string(path) + "> has \"" + word + "\", must be a finite number >= 0");
    }
    values.push_back(*value);
  }
  if (values.size() == 1) return Vec3::Constant(values[0]);
  if (values.size() == 3) return {values[0], values[1], values[2]};
  throw params.error(path, "<" + std::string(path) + "> has " + std::to_string(values.size()) +
                               " numbers, must have 1 or 3");
}

Vec3 with_errors(const Vec3& value, const Vec3& stddev, Rng& rng) {
  if (stddev.isZero(0.0)) return value;
  Vec3 errors;
  rng.gaussians(errors.data(), 3);
  return value + stddev.cwiseProduct(errors);
}

}  // namespace angen::robots

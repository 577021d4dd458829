// Models that appear in the furniture of a flat come out of it with hardly any energy gained.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "angen_sim/physics/models.h"
#include "core/random.h"
#include "sdf/load.h"

namespace angen::physics::testing {
namespace {

constexpr int kTicks = 500;
constexpr int kSpawns = 130;  // of each model ten
const std::string kWorlds = ANGEN_WORLDS_DIR;

/// Kinetic and spring energy of all that is awake, less the work of gravity along the velocities:
/// the way that the push out of an overlap moves a body is not counted, its fall afterwards is.
class Energy {
 public:
  explicit Energy(const TestWorld& world) : world_(world) {}

  void add(ModelId id, const desc::Model& model) {
    const std::vector<LinkId>& links = world_.links(id);
    for (std::size_t i = 0; i < links.size(); ++i) {
      if (world_.mass(links[i]) > 0.0) inertials_[links[i]] = model.links[i].inertial;
      if (model.links[i].gravity) heavy_.insert(links[i]);
    }
    const std::vector<JointId>& joints = world_.joints(id);
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const std::vector<desc::JointAxis>& axes = model.joints[i].axes;
      if (!axes.empty() && axes[0].spring_stiffness > 0.0) springs_.push_back({joints[i], axes[0]});
    }
  }
  void forget(ModelId id) {
    for (const LinkId link : world_.links(id)) {
      inertials_.erase(link);
      heavy_.erase(link);
    }
  }

  /// After each step; J.
  double now() {
    double energy = 0.0;
    awake_.clear();
    world_.list_awake(awake_);
    for (const LinkId link : awake_) {
      const auto found = inertials_.find(link);
      if (found == inertials_.end()) continue;
      const desc::Inertial& inertial = found->second;
      const LinkState state = world_.link(link);
      const Vec3 arm = state.pose.rotation * inertial.pose.position;
      const Vec3 velocity = state.linear_velocity + state.angular_velocity.cross(arm);
      const Vec3 spin =
          (state.pose.rotation * inertial.pose.rotation).conjugate() * state.angular_velocity;
      energy +=
          0.5 * inertial.mass * velocity.squaredNorm() + 0.5 * spin.dot(inertial.moment * spin);
      if (heavy_.count(link) != 0) fallen_ -= inertial.mass * 9.81 * velocity.z() * kStep;
    }
    for (const auto& [joint, axis] : springs_) {
      const double strain = world_.joint(joint).position - axis.spring_reference;
      energy += 0.5 * axis.spring_stiffness * strain * strain;
    }
    return energy - fallen_;
  }

 private:
  const TestWorld& world_;
  std::map<LinkId, desc::Inertial> inertials_;
  std::set<LinkId> heavy_;  // that gravity acts on: not an oven's door, which is balanced
  std::vector<std::pair<JointId, desc::JointAxis>> springs_;
  std::vector<LinkId> awake_;
  double fallen_ = 0.0;  // J, work of gravity
};

desc::Model loose_model(const std::string& name, const Pose& pose) {
  load::SearchPaths paths;
  paths.models = {kWorlds + "/models"};
  return load::model("model://" + name, "guest", pose, paths);
}

bool is_person(const desc::Model& model) {
  return !model.plugins.empty() && model.plugins[0].filename == "libperson_controller.so";
}

/// Models of worlds/models that nothing fixes to the world.
std::vector<std::string> loose_models() {
  std::vector<std::string> names;
  for (const auto& each : std::filesystem::directory_iterator(kWorlds + "/models")) {
    const std::string name = each.path().filename();
    if (!std::filesystem::exists(each.path() / "model.sdf") || name == "sun") continue;
    const desc::Model model = loose_model(name, {});
    const bool fixed = std::any_of(model.joints.begin(), model.joints.end(),
                                   [](const desc::Joint& j) { return j.parent == "world"; });
    if (!model.is_static && !fixed && !model.links.empty() && !is_person(model))
      names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

// With --gtest_repeat=16 it does 2,080 spawns, as each repetition takes the next seed. In them the
// balance rises by at most 0.015 J; with a push that gives speed by 28 kJ. In the first 130 a desk
// is turned by the push while it tips, which would give it 0.92 J if its spin did not turn with it.
TEST(PartingEnergy, ASpawnInTheFlatGainsNone) {
  static std::uint64_t seed = 5;
  Rng rng(++seed, 2, 3);
  const auto between = [&](double low, double high) { return low + (high - low) * rng.uniform(); };
  const desc::World flat = load::world(kWorlds + "/angen.world");
  TestWorld world(flat.physics, flat.gravity);
  Energy energy(world);
  for (const desc::Model& model : flat.models) {
    if (!is_person(model)) energy.add(world.add(model), model);
  }
  world.run(2.0);
  const std::vector<std::string> names = loose_models();
  ASSERT_GT(names.size(), 10U);
  double most = 0.0;  // J
  std::string worst;
  for (int i = 0; i < kSpawns; ++i) {
    const Vec3 at(between(0.5, 9.5), between(0.5, 7.5), between(0.0, 1.2));
    const double roll = between(-0.3, 0.3), pitch = between(-0.3, 0.3);
    const Pose pose{at, from_rpy(roll, pitch, between(-3.14, 3.14))};
    const desc::Model model = loose_model(names[static_cast<std::size_t>(i) % names.size()], pose);
    const ModelId id = world.add(model);
    energy.add(id, model);
    double least = energy.now(), rise = 0.0;
    for (int tick = 0; tick < kTicks; ++tick) {
      world.run(kStep);
      const double now = energy.now();
      least = std::min(least, now);
      rise = std::max(rise, now - least);
    }
    if (rise > most) {
      most = rise;
      worst = names[static_cast<std::size_t>(i) % names.size()];
    }
    energy.forget(id);
    world.remove(id);
    world.run(kStep);
  }
  printf("%d spawns, seed %d: at most %.3f J gained (%s)\n", kSpawns, static_cast<int>(seed), most,
         worst.c_str());
  EXPECT_LT(most, 0.05) << worst;
}

}  // namespace
}  // namespace angen::physics::testing

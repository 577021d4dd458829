// libroboticsgroup_gazebo_mimic_joint_plugin.so
// libroboticsgroup_upatras_gazebo_mimic_joint_plugin.so
#include <cmath>
#include <limits>

#include "plugin/outputs.h"
#include "plugin/registration.h"
#include "plugin/view.h"
#include "plugin/wiring.h"
#include "robots/names.h"

namespace angen::robots {

namespace {

constexpr double kResponse = 0.01;  // s, time constant of the correction
constexpr double kStands = 1e-4;    // rad/s or m/s, below which the brake holds it

struct Mimic {
  std::string joint, mimic;
  double multiplier, offset, most_effort;
};

Mimic read_mimic(Params& params) {
  Mimic m;
  m.joint = params.text("joint", "", "the joint that is followed");
  m.mimic = params.text("mimicJoint", "", "the joint that follows it");
  m.multiplier = params.number("multiplier", 1.0, "", "its position over the other's");
  m.offset = params.number("offset", 0.0, "", "rad or m, added to its position");
  m.most_effort = params.number("maxEffort", 1.0, "", "N m or N, with hasPID", kNotNegative);
  const bool limited = params.flag("hasPID", false, "it follows with at most maxEffort");
  if (!limited) m.most_effort = std::numeric_limits<double>::infinity();
  params.number("sensitiveness", 0.0, "", "rad or m, not used: it follows exactly");
  return m;
}

}  // namespace

/// Holds a joint where another one says.
class MimicJoint : public Device {
 public:
  void configure(Params& params, Wiring& wiring) override {
    mimic_ = read_mimic(params);
    leader_ = wiring.joint(mimic_.joint);
    follower_ = wiring.joint(mimic_.mimic);
  }

  void update(const View& view, Outputs& outputs) override {
    const JointView leader = view.joint(leader_);
    const double target = mimic_.multiplier * leader.position + mimic_.offset;
    const double left = target - view.joint(follower_).position;
    double velocity = mimic_.multiplier * leader.velocity + left / kResponse;
    if (std::abs(velocity) < kStands) velocity = 0.0;
    outputs.motor(follower_, velocity, mimic_.most_effort);
    stands_ = velocity == 0.0;
  }

  Nanoseconds idle_until(const View&) const override { return stands_ ? kForever : 0; }

  void report(const View& view, Reading& state) const override {
    state.set("position", view.joint(follower_).position);
  }

 private:
  Mimic mimic_;
  JointRef leader_, follower_;
  bool stands_ = false;
};

class MimicJointPlugin : public Plugin {
 public:
  ANGEN_DESCRIBED_AS(Kind("mimic_joint", "A joint that follows another one.")
                         .number("position", "", "rad or m")
                         .shown(3))
  std::vector<Mount> mounts(const ModelInfo& model, Params& params) const override {
    const Mimic m = read_mimic(params);
    if (model.joint(m.mimic) == nullptr) return {};
    return {{part_name(model.name, m.mimic), m.mimic}};
  }
  std::string needs() const override { return "the joint that <mimicJoint> names"; }
  std::unique_ptr<Device> make_device() const override { return std::make_unique<MimicJoint>(); }
};

}  // namespace angen::robots

ANGEN_REGISTER_PLUGIN(angen::robots::MimicJointPlugin)

// libgazebo_ros_force.so
#include "plugin/outputs.h"
#include "plugin/registration.h"
#include "plugin/view.h"
#include "plugin/wiring.h"
#include "robots/names.h"

namespace angen::robots {

/// Pushes a link as commanded, until it is commanded otherwise.
class Force : public Device {
 public:
  void configure(Params& params, Wiring& wiring) override {
    params.text("topicName", "", "where wrenches come from, below robotNamespace");
    const std::string body = params.text("bodyName", "", "the link; none: the first");
    link_ = wiring.link(local_name(wiring.model(), body));
    center_ = wiring.center(link_);
  }

  Verdict command(const Command& command, const View&) override {
    return Verdict::accept([this, v = command.values] {
      force_ = {v[0], v[1], v[2]};
      torque_ = {v[3], v[4], v[5]};
    });
  }

  void update(const View& view, Outputs& outputs) override {
    if (!pushes()) return;
    outputs.push(link_, force_, torque_, view.link(link_).pose * center_);
  }

  Nanoseconds idle_until(const View&) const override { return pushes() ? 0 : kForever; }

  void report(const View&, Reading& state) const override {
    state.set("force", numbers(force_));
    state.set("torque", numbers(torque_));
  }

 private:
  bool pushes() const { return !force_.isZero(0.0) || !torque_.isZero(0.0); }

  LinkRef link_;
  Vec3 center_ = Vec3::Zero();  // m, in its frame
  Vec3 force_ = Vec3::Zero();   // N, world
  Vec3 torque_ = Vec3::Zero();  // N m, world
};

class ForcePlugin : public Plugin {
 public:
  ANGEN_DESCRIBED_AS(Kind("force", "A force and a torque on a link, as commanded.")
                         .verb("Stop", "pushes no more")
                         .value_units({"N", "N", "N", "N m", "N m", "N m"})
                         .numbers("force", "N", "x y z in the world, at its center of mass")
                         .shown(2)
                         .numbers("torque", "N m", "about x y z of the world"))
  std::vector<Mount> mounts(const ModelInfo& model, Params& params) const override {
    const std::string body = params.text("bodyName", "", "the link; none: the first");
    return {{part_name(model.name, local_name(model.name, body)), ""}};
  }
  std::unique_ptr<Device> make_device() const override { return std::make_unique<Force>(); }
};

}  // namespace angen::robots

ANGEN_REGISTER_PLUGIN(angen::robots::ForcePlugin)

#include "robots/joint_states.h"

#include <utility>

#include "plugin/view.h"
#include "plugin/wiring.h"

namespace angen::robots {

void JointStates::set_up(std::vector<std::string> names, Wiring& wiring) {
  for (const std::string& name : names) joints_.push_back(wiring.joint(name));
  names_ = std::move(names);
}

void JointStates::read(const View& view, Hits, Rng&, Reading& reading) {
  std::vector<double> positions, velocities, efforts;
  rests_ = true;
  for (const JointRef joint : joints_) {
    const JointView state = view.joint(joint);
    positions.push_back(state.position);
    velocities.push_back(state.velocity);
    efforts.push_back(state.effort);
    rests_ = rests_ && state.velocity == 0.0;
  }
  reading.set("names", names_);
  reading.set("positions", std::move(positions));
  reading.set("velocities", std::move(velocities));
  reading.set("efforts", std::move(efforts));
}

Kind joint_states_kind(std::string name, std::string doc) {
  return Kind(std::move(name), std::move(doc))
      .rate(100.0)
      .texts("names", "of the joints")
      .numbers("positions", "", "rad or m")
      .shown_by_name("names", 2)
      .numbers("velocities", "", "rad/s or m/s")
      .numbers("efforts", "", "N m or N, of joint and motor along the axis");
}

}  // namespace angen::robots

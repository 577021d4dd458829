// libgazebo_ros_joint_state_publisher.so
#include <sstream>

#include "core/text.h"
#include "plugin/registration.h"
#include "robots/base.h"
#include "robots/joint_states.h"

namespace angen::robots {

/// The joints that a comma-separated list names.
class JointStatePublisher : public JointStates {
 public:
  static Kind describe() {
    return joint_states_kind("joint_states", "Positions of a robot's joints.");
  }
  void configure(Params& params, Wiring& wiring) override {
    std::istringstream list(params.text("jointName", "", "names of joints, with commas between"));
    std::vector<std::string> names;
    for (std::string name; std::getline(list, name, ',');) names.push_back(trimmed(name));
    if (names.empty()) {
      throw params.error("jointName", "<jointName> names no joint; give \"a, b\"");
    }
    set_up(std::move(names), wiring);
  }
};

}  // namespace angen::robots

ANGEN_REGISTER_PLUGIN(angen::robots::ModelSensorPlugin<angen::robots::JointStatePublisher>)

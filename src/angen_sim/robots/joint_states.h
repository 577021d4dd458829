#pragma once

#include <string>
#include <utility>
#include <vector>

#include "plugin/plugin.h"

namespace angen::robots {

/// Positions, speeds and efforts of some joints.
class JointStates : public Sensor {
 public:
  void read(const View& view, Hits, Rng&, Reading& reading) override {
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
  bool steady() const override { return rests_; }

 protected:
  void set_up(std::vector<std::string> names, Wiring& wiring) {
    for (const std::string& name : names) joints_.push_back(wiring.joint(name));
    names_ = std::move(names);
  }

 private:
  std::vector<std::string> names_;
  std::vector<JointRef> joints_;
  bool rests_ = false;
};

inline Kind joint_states_kind(std::string name, std::string doc) {
  return Kind(std::move(name), std::move(doc))
      .rate(100.0)
      .texts("names", "of the joints")
      .numbers("positions", "", "rad or m")
      .shown_by_name("names", 2)
      .numbers("velocities", "", "rad/s or m/s")
      .numbers("efforts", "", "N m or N, of joint and motor along the axis");
}

}  // namespace angen::robots

#pragma once

#include <string>
#include <vector>

#include "plugin/plugin.h"

namespace angen::robots {

/// Positions, speeds and efforts of some joints.
class JointStates : public Sensor {
 public:
  void read(const View& view, Hits, Rng&, Reading& reading) override;
  Nanoseconds idle_until(const Ahead&) const override { return rests_ ? kForever : 0; }

 protected:
  void set_up(std::vector<std::string> names, Wiring& wiring);

 private:
  std::vector<std::string> names_;
  std::vector<JointRef> joints_;
  bool rests_ = false;
};

Kind joint_states_kind(std::string name, std::string doc);

}  // namespace angen::robots

#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

#include "sim/instance.h"

namespace angen::sim {

class Building;

struct FoundDevice {
  const LiveModel* live;
  const DeviceInstance* device;
  Pose pose;   // pose of its model
  Vec3 place;  // see DeviceView::place()
  std::size_t order = 0;
  bool fixed = true;  // its model cannot move

  FoundDevice(const LiveModel& live, const DeviceInstance& device, const Pose& pose);
  Heights heights() const;
};

/// The devices of a building by the fields of their last states, for those fields that were queried
/// since clear().
class DevicesByField {
 public:
  /// The devices that have the field and are in `within`, or whose models are, in the order of the
  /// models. They are valid until the next call.
  std::vector<const FoundDevice*> find(const Building& building, const std::string& field,
                                       const Eigen::AlignedBox3d& within);
  /// To be called when devices came or went, have other fields, or have left Heights around them.
  void clear() { by_field_.clear(); }

 private:
  struct Having {
    std::vector<FoundDevice>
        devices;           // by height: a storey's are found without going through a tower
    double tallest = 0.0;  // m, the largest of their heights
  };
  Having& having(const Building& building, const std::string& field);

  std::unordered_map<std::string, Having> by_field_;
};

}  // namespace angen::sim

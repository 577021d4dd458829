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
  std::size_t order;

  double low() const { return std::min(pose.position.z(), place.z()); }
  double high() const { return std::max(pose.position.z(), place.z()); }
};

/// The devices of a building by the fields of their last states, for those fields that were queried
/// since clear().
class DevicesByField {
 public:
  /// The devices that have the field and are in `within`, or whose models are, in the order of the
  /// models.
  std::vector<FoundDevice> find(const Building& building, const std::string& field,
                                const Eigen::AlignedBox3d& within);
  void clear() { by_field_.clear(); }

 private:
  struct Having {
    std::vector<FoundDevice>
        fixed;             // by height: a storey's are found without going through a tower
    double tallest = 0.0;  // m, the largest span of low() to high() of these
    std::vector<FoundDevice> movable;
  };
  const Having& having(const Building& building, const std::string& field);

  std::unordered_map<std::string, Having> by_field_;
};

}  // namespace angen::sim

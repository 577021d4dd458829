#pragma once

#include <map>
#include <tuple>

#include "light/lamp.h"
#include "rays/device.h"

namespace angen::render {

/// Boxes that the light of lamps can reach before bodies that do not move block it, so that images
/// skip lamps of other rooms.
class Reaches {
 public:
  /// Uses another scene, which must outlive this or the next start.
  void start(RTCScene scene);

  /// Box (m, world) around everything that the lamp can light. Found by rays, so a gap of less than
  /// 4 degrees as seen from the lamp may be missed.
  Eigen::AlignedBox3f of(const light::Lamp& lamp);

 private:
  RTCScene scene_ = nullptr;
  std::map<std::tuple<double, double, double>, Eigen::AlignedBox3f> known_;  // by position
};

}  // namespace angen::render

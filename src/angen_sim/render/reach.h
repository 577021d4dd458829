#pragma once

#include <map>
#include <tuple>

#include "light/lamp.h"
#include "rays/device.h"

namespace angen::render {

/// How far lamps' light comes before what stands still ends it: a lamp in another room costs a
/// picture nothing.
class Reaches {
 public:
  /// Takes another scene, which must outlive this or the next start.
  void start(RTCScene scene);

  /// A box around all that the lamp can light, m. Found by rays, so a gap that is less than 4
  /// degrees wide from the lamp may be missed.
  Eigen::AlignedBox3f of(const light::Lamp& lamp);

 private:
  RTCScene scene_ = nullptr;
  std::map<std::tuple<double, double, double>, Eigen::AlignedBox3f> known_;  // by position
};

}  // namespace angen::render

#include "rays/device.h"

#include <stdexcept>

namespace angen::rays {

// One for the process: a second device would start a worker.
RTCDevice device() {
  static const Embree<RTCDevice> shared(rtcNewDevice("threads=1"));
  if (!shared) throw std::runtime_error("Embree cannot create a device on this machine");
  return shared.get();
}

Hierarchy::Hierarchy(RTCBoundsFunction bounds, RTCIntersectFunctionN intersect,
                     RTCOccludedFunctionN occluded)
    : scene(rtcNewScene(device())), geometry(rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_USER)) {
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetGeometryBoundsFunction(geometry.get(), bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry.get(), intersect);
  rtcSetGeometryOccludedFunction(geometry.get(), occluded);
  rtcAttachGeometry(scene.get(), geometry.get());
  build(nullptr, 0);
}

void Hierarchy::build(const void* data, std::size_t count) {
  rtcSetGeometryUserData(geometry.get(), const_cast<void*>(data));
  rtcSetGeometryUserPrimitiveCount(geometry.get(), static_cast<unsigned>(count));
  rtcCommitGeometry(geometry.get());
  rtcCommitScene(scene.get());
}

}  // namespace angen::rays

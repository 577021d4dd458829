#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <type_traits>

namespace angen::rays {

/// Embree counts references; these give one back.
struct ReleaseEmbree {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
template <class Handle>
using Embree = std::unique_ptr<std::remove_pointer_t<Handle>, ReleaseEmbree>;

/// The process's one device; it has no threads of its own.
RTCDevice device();

/// A scene whose only geometry is a list of primitives that our own functions bound and meet.
struct Hierarchy {
  Embree<RTCScene> scene;
  Embree<RTCGeometry> geometry;

  Hierarchy(RTCBoundsFunction bounds, RTCIntersectFunctionN intersect,
            RTCOccludedFunctionN occluded);

  /// Rebuilds over `count` primitives; `data` is handed to the functions and must stay.
  void build(const void* data, std::size_t count);
};

}  // namespace angen::rays

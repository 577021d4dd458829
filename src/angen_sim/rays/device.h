#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <type_traits>

namespace angen::rays {

/// Releases a reference to an object of Embree.
struct ReleaseEmbree {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
};
template <class Handle>
using Embree = std::unique_ptr<std::remove_pointer_t<Handle>, ReleaseEmbree>;

/// The process's only device, without threads of its own. Throws std::runtime_error if Embree
/// fails.
RTCDevice device();

/// A scene whose only geometry is a list of primitives that our own functions bound and intersect.
struct Hierarchy {
  Embree<RTCScene> scene;
  Embree<RTCGeometry> geometry;

  Hierarchy(RTCBoundsFunction bounds, RTCIntersectFunctionN intersect,
            RTCOccludedFunctionN occluded);

  /// Rebuilds over `count` primitives; passes `data`, which must outlive the hierarchy, to the
  /// functions.
  void build(const void* data, std::size_t count);
};

}  // namespace angen::rays

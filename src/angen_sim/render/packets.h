#pragma once

#include <algorithm>
#include <cstring>

#include "rays/device.h"

/// Packets of 16 rays. Embree traces those that are wider than the processor's vectors one ray at a
/// time, and also the rays that are not valid: without AVX-512 it gets them in two halves.
namespace angen::render {

inline bool has_packets_of_16() {
  static const bool has =
      rtcGetDeviceProperty(rays::device(), RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
  return has;
}

/// Calls trace(valid, half) for both halves of a packet; both types are columns of numbers.
template <class Half, class Packet, class Trace>
void in_halves(const int* valid, Packet& packet, const Trace& trace) {
  constexpr std::size_t kBytes = 8 * sizeof(float);  // bytes of a half's column
  static_assert(sizeof(Packet) == 2 * sizeof(Half));
  for (std::size_t half = 0; half < 2; ++half) {
    alignas(32) int wanted[8];
    std::memcpy(wanted, valid + 8 * half, kBytes);
    if (std::none_of(wanted, wanted + 8, [](int each) { return each != 0; })) continue;
    alignas(32) Half rays;
    char* const whole = reinterpret_cast<char*>(&packet) + half * kBytes;
    char* const part = reinterpret_cast<char*>(&rays);
    for (std::size_t at = 0; at < sizeof rays; at += kBytes) {
      std::memcpy(part + at, whole + 2 * at, kBytes);
    }
    trace(wanted, rays);
    for (std::size_t at = 0; at < sizeof rays; at += kBytes) {
      std::memcpy(whole + 2 * at, part + at, kBytes);
    }
  }
}

inline void intersect(const int* valid, RTCScene scene, RTCIntersectContext& context,
                      RTCRayHit16& rays) {
  if (has_packets_of_16()) {
    rtcIntersect16(valid, scene, &context, &rays);
    return;
  }
  in_halves<RTCRayHit8>(valid, rays, [&](const int* wanted, RTCRayHit8& half) {
    rtcIntersect8(wanted, scene, &context, &half);
  });
}

inline void occlude(const int* valid, RTCScene scene, RTCIntersectContext& context,
                    RTCRay16& rays) {
  if (has_packets_of_16()) {
    rtcOccluded16(valid, scene, &context, &rays);
    return;
  }
  in_halves<RTCRay8>(valid, rays, [&](const int* wanted, RTCRay8& half) {
    rtcOccluded8(wanted, scene, &context, &half);
  });
}

}  // namespace angen::render

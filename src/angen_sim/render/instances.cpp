#include "render/instances.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "rays/device.h"
#include "rays/query.h"

namespace angen::render {

namespace {

// Packets of 16 rays. Embree traces those that are wider than the processor's vectors one ray at a
// time, and also the rays that are not valid: without AVX-512 it gets them in two halves.
bool has_packets_of_16() {
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

void intersect(const int* valid, RTCScene scene, RTCIntersectContext& context, RTCRayHit16& rays) {
  if (has_packets_of_16()) {
    rtcIntersect16(valid, scene, &context, &rays);
    return;
  }
  in_halves<RTCRayHit8>(valid, rays, [&](const int* wanted, RTCRayHit8& half) {
    rtcIntersect8(wanted, scene, &context, &half);
  });
}

void occlude(const int* valid, RTCScene scene, RTCIntersectContext& context, RTCRay16& rays) {
  if (has_packets_of_16()) {
    rtcOccluded16(valid, scene, &context, &rays);
    return;
  }
  in_halves<RTCRay8>(valid, rays, [&](const int* wanted, RTCRay8& half) {
    rtcOccluded8(wanted, scene, &context, &half);
  });
}

}  // namespace

Face Placed::in_world(Face face) const {
  for (Eigen::Vector3f& corner : face.corners) corner = rotation * corner + position;
  return face;
}

Instances::Instances() : seen_(rtcNewScene(rays::device())), opaque_(rtcNewScene(rays::device())) {
  for (const RTCScene scene : {seen_.get(), opaque_.get()}) {
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene);
  }
}

std::uint32_t Instances::add(std::unique_ptr<Patch> patch, const Pose& pose, bool throws_shadows) {
  const auto number = static_cast<std::uint32_t>(placed_.size());
  Placed placed;
  placed.instance.reset(rtcNewGeometry(rays::device(), RTC_GEOMETRY_TYPE_INSTANCE));
  rtcSetGeometryInstancedScene(placed.instance.get(), patch->scene());
  placed.patch = std::move(patch);
  placed.shines_through = !throws_shadows;
  rtcAttachGeometryByID(seen_.get(), placed.instance.get(), number);
  if (throws_shadows) rtcAttachGeometryByID(opaque_.get(), placed.instance.get(), number);
  placed_.push_back(std::move(placed));
  place(number, pose);
  return number;
}

void Instances::set_fixed(std::unique_ptr<Patch> patch) {
  placed_.emplace_back();
  placed_.back().patch = std::move(patch);
}

void Instances::place(std::uint32_t number, const Pose& pose) {
  Placed& placed = placed_[number];
  Eigen::Matrix<float, 3, 4> transform;
  transform.leftCols<3>() = pose.rotation.normalized().toRotationMatrix().cast<float>();
  transform.col(3) = pose.position.cast<float>();
  placed.rotation = transform.leftCols<3>();
  placed.position = transform.col(3);
  rtcSetGeometryTransform(placed.instance.get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR,
                          transform.data());
  rtcCommitGeometry(placed.instance.get());
}

void Instances::clear() {
  for (std::uint32_t i = 0; i < placed_.size(); ++i) {
    if (!placed_[i].instance) continue;
    rtcDetachGeometry(seen_.get(), i);
    if (!placed_[i].shines_through) rtcDetachGeometry(opaque_.get(), i);
  }
  placed_.clear();
}

void Instances::commit() {
  rtcCommitScene(seen_.get());
  rtcCommitScene(opaque_.get());
  std::vector<Box> boxes;
  boxed_.clear();
  for (std::uint32_t i = 0; i < placed_.size(); ++i) {
    const Placed& placed = placed_[i];
    if (!placed.instance || placed.patch->is_empty()) continue;
    const Box& own = placed.patch->bounds();
    const Eigen::Vector3f center = placed.rotation * own.center() + placed.position;
    const Eigen::Vector3f half = placed.rotation.cwiseAbs() * own.sizes() / 2.0F;
    boxes.emplace_back(center - half, center + half);
    boxed_.push_back(i);
  }
  boxes_.build(boxes);
}

void Instances::find_hits(const int* valid, const Among& among, RTCIntersectContextFlags flags,
                          RTCRayHit16& rays) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = flags;
  if (among.fixed) {
    intersect(valid, fixed().scene(), context, rays);
    for (int i = 0; i < 16; ++i) {
      const bool hit = rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
      if (hit && rays.hit.instID[0][i] == RTC_INVALID_GEOMETRY_ID) {
        rays.hit.instID[0][i] = fixed_number();
      }
    }
  }
  if (among.movers) intersect(valid, seen_.get(), context, rays);
}

void Instances::find_occluded(const int* wanted, const Among& among, RTCRay16& rays) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if (among.fixed) occlude(wanted, fixed().scene(), context, rays);
  if (!among.movers) return;
  alignas(64) int left[16];
  int any = 0;
  for (int i = 0; i < 16; ++i) {
    left[i] = rays.tfar[i] >= 0.0F ? wanted[i] : 0;
    any |= left[i];
  }
  if (any != 0) occlude(left, opaque_.get(), context, rays);
}

bool Instances::has_opaque_mover_in(const Box& box) const {
  return boxes_.any([&](const Boxes4& boxes) { return overlapping(box, boxes); },
                    [&](std::uint32_t i) { return !placed_[boxed_[i]].shines_through; });
}

bool Instances::find_face(const Eigen::Vector3f& from, const Eigen::Vector3f& to,
                          Face& face) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit ray{};
  rays::aim(ray.ray, from.cast<double>(), (to - from).cast<double>(), 0.0, 1.0);
  ray.hit.geomID = ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(fixed().scene(), &context, &ray);
  rtcIntersect1(opaque_.get(), &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  face.count = 0;
  if (ray.hit.geomID != 0) return true;  // a heightmap
  const bool moves = ray.hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
  const Placed& placed = moves ? placed_[ray.hit.instID[0]] : placed_.back();
  face = placed.in_world(placed.patch->face(ray.hit.primID));
  return true;
}

void Instances::find_in(const Hull& hull, Obstacles& found) const {
  found.faces.count = 0;
  found.unknown = {false, false};
  any_mover_in(hull, [&](std::uint32_t number) {
    const Placed& placed = placed_[number];
    if (placed.shines_through) return false;
    const std::size_t before = found.faces.count;
    if (!placed.patch->find_in(placed.in_patch(hull), found.faces)) {
      found.unknown.movers = true;
      found.faces.count = before;
    }
    for (std::size_t k = before; k < found.faces.count; ++k) {
      found.faces.all[k] = placed.in_world(found.faces.all[k]);
    }
    return false;
  });
  const std::size_t moving = found.faces.count;
  if (!fixed().find_in(hull, found.faces)) {
    found.unknown.fixed = true;
    found.faces.count = moving;
  }
}

}  // namespace angen::render

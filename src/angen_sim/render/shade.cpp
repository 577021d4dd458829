#include "render/shade.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/texture.h"
#include "light/beam.h"

namespace angen::render {
namespace {

constexpr float kMin = 0.1F;        // lx; less is not worth a shadow ray
constexpr float kFarAway = 1e4F;    // m, the farthest shadow of a directional lamp
constexpr float kSamePlace = 0.1F;  // m; reflected light is that of patches of 0.4 m
constexpr float kSameWay = 0.98F;   // cosine between normals
constexpr int kCodes = 1 << 14;

/// sRGB bytes of evenly spaced linear values.
std::array<std::uint8_t, kCodes + 1> make_codes() {
  std::array<std::uint8_t, kCodes + 1> codes{};
  for (int i = 0; i <= kCodes; ++i) {
    codes[static_cast<std::size_t>(i)] = srgb(static_cast<double>(i) / kCodes);
  }
  return codes;
}

/// lx of a lamp on a surface that faces it: a point lamp here, any other by `light`.
struct Source {
  explicit Source(const light::Lit& lit)
      : lamp(lit.lamp), level(lit.level), position(lit.lamp.pose.position.cast<float>()) {
    is_point = lamp.type == light::Lamp::Type::kPoint && !lamp.photometry;
    candela = static_cast<float>(level * lamp.luminous_flux / (4.0 * M_PI));
    nearest2 = static_cast<float>(lamp.radius * lamp.radius);
  }

  /// `way` is set to the vector from the point to the lamp, m.
  float illuminance(const Eigen::Vector3f& point, Eigen::Vector3f& way) const {
    if (is_point) {
      way = position - point;
      return candela / std::max(nearest2, way.squaredNorm());
    }
    const light::Beam beam = light::beam(lamp, point.cast<double>());
    const double length = std::min<double>(beam.distance, kFarAway);
    way = (length * beam.towards).cast<float>();
    return static_cast<float>(level * beam.illuminance);
  }

  const light::Lamp& lamp;
  double level;
  Eigen::Vector3f position;
  bool is_point;
  float candela;
  float nearest2;
};

void set_segment(const Eigen::Vector3f& from, const Eigen::Vector3f& way, int i, RTCRay16& rays) {
  rays.org_x[i] = from.x();
  rays.org_y[i] = from.y();
  rays.org_z[i] = from.z();
  rays.dir_x[i] = way.x();
  rays.dir_y[i] = way.y();
  rays.dir_z[i] = way.z();
  rays.tnear[i] = 0.0F;
  rays.tfar[i] = 1.0F;
  rays.time[i] = 0.0F;
  rays.mask[i] = UINT32_MAX;
  rays.id[i] = 0;
  rays.flags[i] = 0;
}

/// Sets tfar of rays with a hit below 0.
void find_occluded(const int* wanted, RTCScene opaque, RTCRay16& rays) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded16(wanted, opaque, &context, &rays);
}

/// Which points are visible from another, as bits; see light::ReflectedLookup.
std::uint32_t seen_from(const Eigen::Vector3f& from, const Eigen::Vector3f* to, int count,
                        RTCScene opaque) {
  alignas(64) int wanted[kLanes] = {};
  alignas(64) RTCRay16 rays;
  for (int i = 0; i < kLanes; ++i) {
    wanted[i] = i < count ? -1 : 0;
    set_segment(from, i < count ? Eigen::Vector3f(to[i] - from) : Eigen::Vector3f::Zero(), i, rays);
  }
  find_occluded(wanted, opaque, rays);
  std::uint32_t seen = 0;
  for (int i = 0; i < count; ++i) {
    if (rays.tfar[i] >= 0.0F) seen |= 1U << i;
  }
  return seen;
}

}  // namespace

static_assert(light::ReflectedLookup::kMax == kLanes);

void shine(const light::Lit& lit, RTCScene opaque, Tile& tile) {
  const Source source(lit);
  alignas(64) int wanted[kLanes];
  alignas(64) RTCRay16 rays;
  float illuminance[kLanes];
  bool any = false;
  for (int i = 0; i < kLanes; ++i) {
    wanted[i] = 0;
    rays.tfar[i] = 0.0F;
    if (tile.valid[i] == 0) continue;
    Eigen::Vector3f way;
    const float facing = source.illuminance(tile.point[i], way);
    const float distance = way.norm();
    float cosine = tile.normal[i].dot(way) / distance;
    if (tile.through[i]) cosine = std::abs(cosine);
    illuminance[i] = facing * cosine;
    if (!(illuminance[i] > kMin)) continue;
    wanted[i] = -1;
    any = true;
    set_segment(lifted(tile, i), way, i, rays);
  }
  if (!any) return;
  if (lit.lamp.cast_shadows && opaque != nullptr) find_occluded(wanted, opaque, rays);
  for (int i = 0; i < kLanes; ++i) {
    if (wanted[i] != 0 && rays.tfar[i] >= 0.0F) tile.light[i] += illuminance[i] * lit.lamp.color;
  }
}

Reflections::Reflections(const light::ReflectedLight& light, RTCScene opaque)
    : lookup_(light, [opaque](const auto& from, const auto* to, int count) {
        return seen_from(from, to, count, opaque);
      }) {}

const Reflections::Known* Reflections::find(const Some& all, int count,
                                            const Eigen::Vector3f& point,
                                            const Eigen::Vector3f& normal) {
  const auto end = all.begin() + count;
  const auto found = std::find_if(all.begin(), end, [&](const Known& known) {
    return normal.dot(known.normal) > kSameWay &&
           (point - known.point).squaredNorm() < kSamePlace * kSamePlace;
  });
  return found == end ? nullptr : &*found;
}

void Reflections::shine(Tile& tile) {
  Strip& strip = strips_[static_cast<std::size_t>(tile.row / kTile % kTilesAcross)];
  Some now;
  int count = 0;
  for (int i = 0; i < kLanes; ++i) {
    if (tile.valid[i] == 0) continue;
    const Eigen::Vector3f& point = tile.point[i];
    const Eigen::Vector3f& normal = tile.normal[i];
    const Known* known = find(now, count, point, normal);
    if (known == nullptr) {
      const Known* before = find(strip.last, strip.count, point, normal);
      now[count] = before != nullptr ? *before : Known{point, normal, lookup_.at(point, normal)};
      known = &now[count++];
    }
    tile.light[i] += known->light;
  }
  std::copy_n(now.begin(), count, strip.last.begin());
  strip.count = count;
}

std::uint8_t shown(float luminance) {
  static const std::array<std::uint8_t, kCodes + 1> codes = make_codes();
  const float value = std::max(0.0F, luminance) / (std::max(0.0F, luminance) + kMiddleLuminance);
  return codes[static_cast<std::size_t>(value * kCodes + 0.5F)];
}

std::uint8_t shown_as_is(float value) {
  return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(value, 0.0F, 1.0F)));
}

}  // namespace angen::render

#include "render/shade.h"

#include <algorithm>
#include <cmath>

#include "core/texture.h"
#include "light/beam.h"

namespace angen::render {
namespace {

constexpr float kMin = 0.1F;            // lx; less is not worth a test for shadows
constexpr float kBeforeLamp = 0.9999F;  // share of a shadow ray; the lamp may be in a surface
constexpr float kFarAway = 1e4F;        // m, the farthest shadow of a directional lamp
constexpr float kEdgeOn = 1e-6F;  // m from the lamp to the plane of a face that it sees as a line
constexpr int kCodes = 1 << 14;

/// sRGB bytes of evenly spaced linear values.
std::array<std::uint8_t, kCodes + 1> make_codes() {
  std::array<std::uint8_t, kCodes + 1> codes{};
  for (int i = 0; i <= kCodes; ++i) {
    codes[static_cast<std::size_t>(i)] = srgb(static_cast<double>(i) / kCodes);
  }
  return codes;
}

/// lx of a lamp on surfaces that face it, at the valid points. `way` is set to the vectors from the
/// points to the lamp, m.
Lanes facing_illuminance(const light::Lit& lit, const Tile& tile, Columns& way) {
  const light::Lamp& lamp = lit.lamp;
  if (lamp.type == light::Lamp::Type::kPoint && !lamp.photometry) {
    const Eigen::Vector3f position = lamp.pose.position.cast<float>();
    const auto candela = static_cast<float>(lit.level * lamp.luminous_flux / (4.0 * M_PI));
    const auto nearest2 = static_cast<float>(lamp.radius * lamp.radius);
    way.x = position.x() - tile.point.x;
    way.y = position.y() - tile.point.y;
    way.z = position.z() - tile.point.z;
    return candela / way.dot(way).max(nearest2);
  }
  Lanes illuminance = Lanes::Zero();
  for (int i = 0; i < kLanes; ++i) {
    if (tile.valid[i] == 0) continue;
    const light::Beam beam = light::beam(lamp, tile.point[i].cast<double>());
    const double length = std::min<double>(beam.distance, kFarAway);
    way.set(i, (length * beam.towards).cast<float>());
    illuminance[i] = static_cast<float>(lit.level * beam.illuminance);
  }
  return illuminance;
}

/// Lengths without Eigen's approximate square root.
Lanes lengths(const Columns& of) {
  Lanes squares = of.dot(of);
  for (int i = 0; i < kLanes; ++i) squares[i] = std::sqrt(squares[i]);
  return squares;
}

}  // namespace

void set_segments(const Columns& from, const Columns& way, RTCRay16& rays) {
  using Map = Eigen::Map<Lanes>;
  Map(rays.org_x) = from.x;
  Map(rays.org_y) = from.y;
  Map(rays.org_z) = from.z;
  Map(rays.dir_x) = way.x;
  Map(rays.dir_y) = way.y;
  Map(rays.dir_z) = way.z;
  Map(rays.tnear) = 0.0F;
  Map(rays.tfar) = 1.0F;
  Map(rays.time) = 0.0F;
  for (int i = 0; i < kLanes; ++i) {
    rays.mask[i] = UINT32_MAX;
    rays.id[i] = 0;
    rays.flags[i] = 0;
  }
}

void drop_hidden(const Faces& faces, const Eigen::Vector3f& from, const Columns& points,
                 int* seen) {
  const Columns way{points.x - from.x(), points.y - from.y(), points.z - from.z()};
  const auto along = [&](const Eigen::Vector3f& vector) -> Lanes {
    return way.x * vector.x() + (way.y * vector.y() + way.z * vector.z());
  };
  for (std::size_t n = 0; n < faces.count; ++n) {
    const Face& face = faces.all[n];
    const auto corner = [&](std::size_t k) { return face.corners[k] - from; };
    const Eigen::Vector3f normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    const float volume = normal.dot(corner(0));
    if (!(std::abs(volume) > kEdgeOn * normal.norm())) continue;
    const float side = volume > 0.0F ? 1.0F : -1.0F;
    // Only signs count: of the side of the plane, then of each edge.
    Lanes inside = along(normal) / volume - 1.0F;
    for (std::size_t k = 0; k < face.count; ++k) {
      inside = inside.min(along(side * corner(k).cross(corner(k + 1 < face.count ? k + 1 : 0))));
    }
    for (int i = 0; i < kLanes; ++i) seen[i] = inside[i] >= 0.0F ? 0 : seen[i];
  }
}

void shine(const light::Lit& lit, const Instances& instances, const Obstacles* obstacles,
           Tile& tile) {
  Columns way;
  const Lanes facing = facing_illuminance(lit, tile, way);
  Lanes cosine = tile.normal.dot(way) / lengths(way);
  for (int i = 0; i < kLanes; ++i) {
    if (tile.through[i]) cosine[i] = std::abs(cosine[i]);
  }
  Lanes illuminance = facing * cosine;
  alignas(64) int seen[kLanes];
  for (int i = 0; i < kLanes; ++i) {
    seen[i] = tile.valid[i] != 0 && illuminance[i] > kMin ? -1 : 0;
  }
  const auto any = [&] {
    return std::any_of(seen, seen + kLanes, [](int each) { return each != 0; });
  };
  if (!any()) return;
  if (lit.lamp.cast_shadows && obstacles != nullptr) {
    const Eigen::Vector3f lamp = lit.lamp.pose.position.cast<float>();
    drop_hidden(obstacles->faces, lamp, tile.lifted, seen);
    if (!any()) return;
    if (!obstacles->unknown.none()) {
      if (lit.lamp.type != light::Lamp::Type::kDirectional) {
        way = {lamp.x() - tile.lifted.x, lamp.y() - tile.lifted.y, lamp.z() - tile.lifted.z};
      }
      alignas(64) RTCRay16 rays;
      set_segments(tile.lifted, way, rays);
      std::fill(rays.tfar, rays.tfar + kLanes, kBeforeLamp);
      instances.find_occluded(seen, obstacles->unknown, rays);
      for (int i = 0; i < kLanes; ++i) {
        if (!(rays.tfar[i] >= 0.0F)) seen[i] = 0;
      }
    }
  }
  for (int i = 0; i < kLanes; ++i) illuminance[i] = seen[i] != 0 ? illuminance[i] : 0.0F;
  tile.light.x += illuminance * lit.lamp.color.x();
  tile.light.y += illuminance * lit.lamp.color.y();
  tile.light.z += illuminance * lit.lamp.color.z();
}

std::array<std::uint8_t, kLanes> shown(const Lanes& luminances) {
  static const std::array<std::uint8_t, kCodes + 1> codes = make_codes();
  Lanes least;  // 0 for NaN, too
  for (int i = 0; i < kLanes; ++i) least[i] = luminances[i] > 0.0F ? luminances[i] : 0.0F;
  const Lanes shares = least / (least + kMiddleLuminance);
  const Eigen::Array<int, kLanes, 1> places =
      (shares * static_cast<float>(kCodes) + 0.5F).cast<int>();
  std::array<std::uint8_t, kLanes> bytes;
  for (int i = 0; i < kLanes; ++i) {
    bytes[static_cast<std::size_t>(i)] = codes[static_cast<std::size_t>(places[i])];
  }
  return bytes;
}

std::uint8_t shown_as_is(float value) {
  return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(value, 0.0F, 1.0F)));
}

}  // namespace angen::render

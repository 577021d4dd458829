#include "render/shade.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/cells.h"
#include "core/texture.h"
#include "light/beam.h"

namespace angen::render {
namespace {

constexpr float kMin = 0.1F;       // lx; less is not worth a shadow ray
constexpr float kFarAway = 1e4F;   // m, the farthest shadow of a directional lamp
constexpr float kCell = 0.1F;      // m; reflected light is that of patches of 0.4 m
constexpr float kFarCells = 4.0F;  // m; cells beyond are twice as large
constexpr float kMostCells = 1e9F;
constexpr float kCellShift = 0.37F;  // of a cell, so that walls are not at the sides of cells
constexpr float kWays = 7.0F;        // steps of 8 degrees
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

/// Which points are visible from another, as bits; see light::ReflectedLookup.
std::uint32_t seen_from(const Eigen::Vector3f& from, const Eigen::Vector3f* to, int count,
                        const Instances& instances) {
  alignas(64) int wanted[kLanes] = {};
  alignas(64) RTCRay16 rays;
  Columns all, way;
  all.set_all(from);
  Box box(from);
  for (int i = 0; i < count; ++i) {
    wanted[i] = -1;
    way.set(i, to[i] - from);
    box.extend(to[i]);
  }
  set_segments(all, way, rays);
  box.min().array() -= kLift;
  box.max().array() += kLift;
  instances.find_occluded(wanted, {true, instances.has_opaque_mover_in(box)}, rays);
  std::uint32_t seen = 0;
  for (int i = 0; i < count; ++i) {
    if (rays.tfar[i] >= 0.0F) seen |= 1U << i;
  }
  return seen;
}

}  // namespace

static_assert(light::ReflectedLookup::kMax == kLanes);

void shine(const light::Lit& lit, const Instances& instances, const Among& among, Tile& tile) {
  Columns way;
  const Lanes facing = facing_illuminance(lit, tile, way);
  Lanes cosine = tile.normal.dot(way) / lengths(way);
  for (int i = 0; i < kLanes; ++i) {
    if (tile.through[i]) cosine[i] = std::abs(cosine[i]);
  }
  Lanes illuminance = facing * cosine;
  alignas(64) int wanted[kLanes];
  bool any = false;
  for (int i = 0; i < kLanes; ++i) {
    wanted[i] = tile.valid[i] != 0 && illuminance[i] > kMin ? -1 : 0;
    if (wanted[i] == 0) illuminance[i] = 0.0F;
    any = any || wanted[i] != 0;
  }
  if (!any) return;
  if (lit.lamp.cast_shadows && !among.none()) {
    alignas(64) RTCRay16 rays;
    set_segments(tile.lifted, way, rays);
    instances.find_occluded(wanted, among, rays);
    for (int i = 0; i < kLanes; ++i) {
      if (!(rays.tfar[i] >= 0.0F)) illuminance[i] = 0.0F;
    }
  }
  tile.light.x += illuminance * lit.lamp.color.x();
  tile.light.y += illuminance * lit.lamp.color.y();
  tile.light.z += illuminance * lit.lamp.color.z();
}

Reflections::Reflections(const light::ReflectedLight& light, const Instances& instances)
    : lookup_(light, [&instances](const auto& from, const auto* to, int count) {
        return seen_from(from, to, count, instances);
      }) {}

/// Numbers of cells along an axis.
Reflections::Whole Reflections::cells(const Lanes& along, const Lanes& per_meter) {
  Whole cells;
  for (int i = 0; i < kLanes; ++i) {
    const float at = std::clamp(along[i] * per_meter[i] + kCellShift, -kMostCells, kMostCells);
    const auto cell = static_cast<int>(at);
    cells[i] = cell - (static_cast<float>(cell) > at ? 1 : 0);
  }
  return cells;
}

/// Numbers of ways to face, along an axis.
Reflections::Whole Reflections::ways(const Lanes& along) {
  Whole ways;
  for (int i = 0; i < kLanes; ++i) ways[i] = static_cast<int>(kWays * along[i] + kWays + 1.5F);
  return ways;
}

/// Light at a point, or at one that came before in its cell.
const Eigen::Vector3f& Reflections::at(const Key& key, const Tile& tile, int i) {
  const auto [entry, fresh] = known_.try_emplace(key);
  if (fresh) entry->second = lookup_.at(tile.point[i], tile.normal[i]);
  return entry->second;
}

void Reflections::shine(Tile& tile) {
  Lanes per_meter;
  for (int i = 0; i < kLanes; ++i)
    per_meter[i] = tile.depth[i] > kFarCells ? 0.5F / kCell : 1.0F / kCell;
  const Whole x = cells(tile.point.x, per_meter), y = cells(tile.point.y, per_meter),
              z = cells(tile.point.z, per_meter);
  const Whole u = ways(tile.normal.x), v = ways(tile.normal.y), w = ways(tile.normal.z);
  std::array<std::pair<int, const Eigen::Vector3f*>, kLanes> found;  // the first pixel of each cell
  std::size_t count = 0;
  for (int i = 0; i < kLanes; ++i) {
    if (tile.valid[i] == 0) continue;
    const auto is_same = [&](const auto& other) {
      const int k = other.first;
      return ((x[i] ^ x[k]) | (y[i] ^ y[k]) | (z[i] ^ z[k]) | (u[i] ^ u[k]) | (v[i] ^ v[k]) |
              (w[i] ^ w[k])) == 0;
    };
    auto known = std::find_if(found.begin(), found.begin() + count, is_same);
    if (known == found.begin() + count) {
      const Key key{cell_key(x[i], y[i], z[i]),
                    u[i] << 8 | v[i] << 4 | w[i] | (tile.depth[i] > kFarCells ? 1 << 12 : 0)};
      *known = {i, &at(key, tile, i)};
      ++count;
    }
    tile.light.set(i, tile.light[i] + *known->second);
  }
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

#include "render/picture.h"

#include <algorithm>

namespace angen::render {
namespace {

std::size_t index_of(int width, int column, int row) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(column);
}

Box box_of(const Columns& points) {
  const auto& [x, y, z] = points;
  return Box(Eigen::Vector3f(x.minCoeff(), y.minCoeff(), z.minCoeff()),
             Eigen::Vector3f(x.maxCoeff(), y.maxCoeff(), z.maxCoeff()));
}

void set_boxes(Tile& tile) {
  if (tile.is_even) {
    tile.seen = box_of(tile.point);
    tile.starts = box_of(tile.lifted);
    return;
  }
  tile.seen.setEmpty();
  tile.starts.setEmpty();
  for (int i = 0; i < kLanes; ++i) {
    if (tile.valid[i] == 0) continue;
    tile.seen.extend(tile.point[i]);
    tile.starts.extend(tile.lifted[i]);
  }
}

void set_points(const RTCRay16& rays, Tile& tile) {
  using Map = Eigen::Map<const Lanes, Eigen::Aligned64>;
  tile.depth = Map(rays.tfar);
  tile.point.x = Map(rays.org_x) + Map(rays.tfar) * Map(rays.dir_x);
  tile.point.y = Map(rays.org_y) + Map(rays.tfar) * Map(rays.dir_y);
  tile.point.z = Map(rays.org_z) + Map(rays.tfar) * Map(rays.dir_z);
  tile.lifted.x = tile.point.x + kLift * tile.normal.x;
  tile.lifted.y = tile.point.y + kLift * tile.normal.y;
  tile.lifted.z = tile.point.z + kLift * tile.normal.z;
}

bool is_same_facet(const RTCHit16& hits, int i, int k) {
  return hits.primID[i] == hits.primID[k] && hits.geomID[i] == hits.geomID[k] &&
         hits.instID[0][i] == hits.instID[0][k];
}

/// Whether all pixels have the hit of the first one.
bool is_one_facet(const TracedTile& tile) {
  const RTCHit16& hits = tile.rays.hit;
  unsigned other = hits.geomID[0] == RTC_INVALID_GEOMETRY_ID ? 1U : 0U;
  for (int i = 0; i < kLanes; ++i) {
    other |= (hits.primID[i] ^ hits.primID[0]) | (hits.geomID[i] ^ hits.geomID[0]) |
             (hits.instID[0][i] ^ hits.instID[0][0]) | static_cast<unsigned>(~tile.valid[i]);
  }
  return other == 0;
}

/// Sets what comes from the facet; false if it is seen from both sides.
bool set_even(const Instances& instances, const TracedTile& from, Tile& tile) {
  const RTCHit16& hits = from.rays.hit;
  const Placed& placed = instances[hits.instID[0][0]];
  const Facet facet = placed.patch->facet(hits.geomID[0], hits.primID[0]);
  const Eigen::Vector3f normal = placed.rotation * facet.normal;
  int behind = 0;
  for (int i = 0; i < kLanes; ++i) behind += normal.dot(from.direction(i)) > 0.0F ? 1 : 0;
  if (behind != 0 && behind != kLanes) return false;
  const Finish& finish = placed.patch->finish(facet);
  tile.normal.set_all(behind != 0 ? Eigen::Vector3f(-normal) : normal);
  if (!finish.texture) tile.color.set_all(finish.color);
  for (int i = 0; i < kLanes; ++i) {
    tile.in_image[i] = true;
    tile.valid[i] = -1;
    tile.through[i] = placed.shines_through;
    tile.finish[i] = &finish;
    if (finish.texture) tile.color.set(i, placed.patch->color(facet, hits.u[i], hits.v[i]));
  }
  return true;
}

void set_each(const Instances& instances, const TracedTile& from, Tile& tile) {
  const RTCHit16& hits = from.rays.hit;
  const Placed* placed = nullptr;
  Facet facet;
  Eigen::Vector3f normal;
  int last = -1;  // the pixel before with a hit
  for (int i = 0; i < kLanes; ++i) {
    tile.in_image[i] = from.valid[i] != 0;
    tile.valid[i] = from.has_hit(i) ? -1 : 0;
    tile.through[i] = false;
    if (tile.valid[i] == 0) continue;
    if (last < 0 || !is_same_facet(hits, i, last)) {
      placed = &instances[hits.instID[0][i]];
      facet = placed->patch->facet(hits.geomID[i], hits.primID[i]);
      normal = placed->rotation * facet.normal;
    }
    last = i;
    tile.normal.set(i, normal.dot(from.direction(i)) > 0.0F ? Eigen::Vector3f(-normal) : normal);
    tile.through[i] = placed->shines_through;
    tile.finish[i] = &placed->patch->finish(facet);
    tile.color.set(i, placed->patch->color(facet, hits.u[i], hits.v[i]));
  }
}

void gather(const Instances& instances, const TracedTile& from, const Eigen::Vector3f& ambient,
            Tile& tile) {
  tile.column = from.column;
  tile.row = from.row;
  tile.light.set_all(ambient);
  tile.is_even = is_one_facet(from) && set_even(instances, from, tile);
  if (!tile.is_even) set_each(instances, from, tile);
  set_points(from.rays.ray, tile);
  set_boxes(tile);
}

/// The bytes of the valid pixels, in one channel.
std::array<std::uint8_t, kLanes> bytes_of(const Tile& tile, const Lanes& color, const Lanes& light,
                                          int channel) {
  Lanes emissive = Lanes::Zero();
  if (tile.is_even) {
    emissive = tile.finish[0]->emissive[channel];
  } else {
    for (int i = 0; i < kLanes; ++i) {
      if (tile.valid[i] != 0) emissive[i] = tile.finish[i]->emissive[channel];
    }
  }
  return shown(color * light / static_cast<float>(M_PI) + kMiddleLuminance * emissive);
}

}  // namespace

void Facing::add(const Eigen::Vector3f& normal, bool through) {
  if (through) turned = true;
  if (turned || (way_count > 0 && ways[way_count - 1] == normal)) return;
  const auto end = ways.begin() + way_count;
  if (std::find(ways.begin(), end, normal) != end) return;
  if (way_count == ways.size()) {
    turned = true;
  } else {
    ways[way_count++] = normal;
  }
}

bool Facing::is_behind(const light::Lamp& lamp, const Box& points) const {
  if (turned || lamp.type == light::Lamp::Type::kDirectional) return false;
  const Eigen::Vector3f position = lamp.pose.position.cast<float>();
  return std::all_of(ways.begin(), ways.begin() + way_count, [&](const Eigen::Vector3f& way) {
    const Eigen::Vector3f nearest = (way.array() > 0.0F).select(points.min(), points.max());
    return way.dot(position - nearest) < -kLift;
  });
}

void DepthWriter::add(const TracedTile& tile) {
  float* first = depths_ + index_of(width_, tile.column, tile.row);
  for (int i = 0; i < kLanes; ++i) {
    if (tile.has_hit(i)) first[i / kTile * width_ + i % kTile] = tile.rays.ray.tfar[i];
  }
}

ColorWriter::ColorWriter(const Instances& instances, const Illumination& by, int width,
                         std::uint8_t* pixels, float* depths)
    : instances_(instances),
      by_(by),
      width_(width),
      pixels_(pixels),
      depths_(width, depths),
      sights_(instances, by.lamps) {
  if (by.ambience.reflected) reflected_.emplace(*by.ambience.reflected, instances, width);
}

void ColorWriter::begin_row_of_blocks() {
  if (reflected_) reflected_->start();
}

void ColorWriter::add(const TracedTile& traced) {
  const auto number = static_cast<std::size_t>(traced.number);
  has_[number] = true;
  gather(instances_, traced, kAmbientIlluminance * by_.ambience.ambient, tiles_[number]);
  depths_.add(traced);
}

void ColorWriter::end_block() {
  if (reflected_) reflected_->shine(tiles_, has_);
  if (!by_.lamps.empty()) set_squares();
  for (std::size_t i = 0; i < by_.lamps.size(); ++i) shine(i, 0, 0, Sight::kSome);
  for (std::size_t k = 0; k < kTiles; ++k) {
    if (has_[k]) write(tiles_[k]);
  }
  has_ = {};
}

void ColorWriter::set_squares() {
  for (Facing& facing : facing_) {
    facing.way_count = 0;
    facing.turned = false;
  }
  for (std::size_t k = 0; k < kTiles; ++k) {
    points_[kFirstTile + k] = has_[k] ? tiles_[k].starts : Box();
    Facing& facing = facing_[k / (kTiles / facing_.size())];
    const int lanes = !has_[k] ? 0 : tiles_[k].is_even ? 1 : kLanes;
    for (int i = 0; i < lanes; ++i) {
      if (tiles_[k].valid[i] != 0) facing.add(tiles_[k].normal[i], tiles_[k].through[i]);
    }
  }
  for (std::size_t square = kFirstTile; square-- > 0;) {
    points_[square].setEmpty();
    for (std::size_t k = 1; k <= 4; ++k) points_[square].extend(points_[4 * square + k]);
  }
}

void ColorWriter::write(const Tile& tile) {
  const auto red = bytes_of(tile, tile.color.x, tile.light.x, 0);
  const auto green = bytes_of(tile, tile.color.y, tile.light.y, 1);
  const auto blue = bytes_of(tile, tile.color.z, tile.light.z, 2);
  std::uint8_t* first = pixels_ + 3 * index_of(width_, tile.column, tile.row);
  for (int i = 0; i < kLanes; ++i) {
    if (!tile.in_image[i]) continue;
    std::uint8_t* pixel = first + 3 * (i / kTile * width_ + i % kTile);
    const auto at = static_cast<std::size_t>(i);
    if (tile.valid[i] != 0) {
      pixel[0] = red[at];
      pixel[1] = green[at];
      pixel[2] = blue[at];
    } else {
      for (int c = 0; c < 3; ++c) pixel[c] = shown_as_is(by_.ambience.background[c]);
    }
  }
}

/// Adds a lamp's light to a square, which is divided where only a part of it sees the lamp.
void ColorWriter::shine(std::size_t lamp, std::size_t level, std::size_t square, Sight sight) {
  const light::Lit& lit = by_.lamps[lamp];
  const Box& points = points_[square];
  if (points.isEmpty()) return;
  const Box around(points.min().array() - kLift, points.max().array() + kLift);
  if (!by_.reaches[lamp].intersects(around)) return;
  if (level == 1 && facing_[square - 1].is_behind(lit.lamp, points)) return;
  if (sight == Sight::kSome) sight = sights_.of(lamp, level, points);
  if (sight == Sight::kNone) return;
  if (level < kDivisions) {
    for (std::size_t k = 1; k <= 4; ++k) shine(lamp, level + 1, 4 * square + k, sight);
    return;
  }
  Tile& tile = tiles_[square - kFirstTile];
  if (!by_.reaches[lamp].intersects(tile.seen)) return;
  render::shine(lit, instances_, sight == Sight::kAll ? nullptr : &sights_.obstacles(level), tile);
}

}  // namespace angen::render

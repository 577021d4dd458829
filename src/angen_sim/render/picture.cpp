#include "render/picture.h"

#include <algorithm>

namespace angen::render {
namespace {

std::size_t index_of(int width, int column, int row, int lane) {
  return static_cast<std::size_t>(row + lane / kTile) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(column + lane % kTile);
}

void set_boxes(Tile& tile) {
  tile.seen.setEmpty();
  tile.starts.setEmpty();
  for (int i = 0; i < kLanes; ++i) {
    if (tile.valid[i] == 0) continue;
    tile.seen.extend(tile.point[i]);
    tile.starts.extend(tile.lifted[i]);
  }
}

void set_points(const RTCRay16& rays, Tile& tile) {
  using Map = Eigen::Map<const Lanes>;
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

void gather(const Instances& instances, const TracedTile& from, const Eigen::Vector3f& ambient,
            Tile& tile) {
  const RTCHit16& hits = from.rays.hit;
  tile.column = from.column;
  tile.row = from.row;
  tile.light.set_all(ambient);
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
  set_points(from.rays.ray, tile);
  set_boxes(tile);
}

BlockView view_of(const Tile* tiles, std::size_t count) {
  BlockView view;
  for (std::size_t k = 0; k < count; ++k) {
    const Tile& tile = tiles[k];
    for (int i = 0; i < kLanes; ++i) {
      if (tile.valid[i] != 0) view.add_way(tile.normal[i], tile.through[i]);
    }
    view.points.extend(tile.starts);
  }
  return view;
}

/// The bytes of the valid pixels, in one channel.
std::array<std::uint8_t, kLanes> bytes_of(const Tile& tile, const Lanes& color, const Lanes& light,
                                          int channel) {
  Lanes emissive = Lanes::Zero();
  for (int i = 0; i < kLanes; ++i) {
    if (tile.valid[i] != 0) emissive[i] = tile.finish[i]->emissive[channel];
  }
  return shown(color * light / static_cast<float>(M_PI) + kMiddleLuminance * emissive);
}

}  // namespace

void BlockView::add_way(const Eigen::Vector3f& normal, bool through) {
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

bool BlockView::is_behind(const light::Lamp& lamp) const {
  if (turned || lamp.type == light::Lamp::Type::kDirectional) return false;
  const Eigen::Vector3f position = lamp.pose.position.cast<float>();
  return std::all_of(ways.begin(), ways.begin() + way_count, [&](const Eigen::Vector3f& way) {
    const Eigen::Vector3f nearest = (way.array() > 0.0F).select(points.min(), points.max());
    return way.dot(position - nearest) < -kLift;
  });
}

void DepthWriter::add(const TracedTile& tile) {
  for (int i = 0; i < kLanes; ++i) {
    if (!tile.has_hit(i)) continue;
    depths_[index_of(width_, tile.column, tile.row, i)] = tile.rays.ray.tfar[i];
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
  if (by.ambience.reflected) reflected_.emplace(*by.ambience.reflected, instances);
}

void ColorWriter::begin_row_of_blocks() {
  if (reflected_) reflected_->start();
}

void ColorWriter::add(const TracedTile& traced) {
  Tile& tile = tiles_[count_++];
  gather(instances_, traced, kAmbientIlluminance * by_.ambience.ambient, tile);
  depths_.add(traced);
}

void ColorWriter::end_block() {
  for (std::size_t k = 0; k < count_; ++k) {
    if (reflected_) reflected_->shine(tiles_[k]);
  }
  if (!by_.lamps.empty()) {
    const BlockView view = view_of(tiles_.data(), count_);
    for (std::size_t i = 0; i < by_.lamps.size() && !view.points.isEmpty(); ++i) shine(i, view);
  }
  for (std::size_t k = 0; k < count_; ++k) write(tiles_[k]);
  count_ = 0;
}

void ColorWriter::write(const Tile& tile) {
  const auto red = bytes_of(tile, tile.color.x, tile.light.x, 0);
  const auto green = bytes_of(tile, tile.color.y, tile.light.y, 1);
  const auto blue = bytes_of(tile, tile.color.z, tile.light.z, 2);
  for (int i = 0; i < kLanes; ++i) {
    if (!tile.in_image[i]) continue;
    std::uint8_t* pixel = pixels_ + 3 * index_of(width_, tile.column, tile.row, i);
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

/// Adds a lamp's light to the block. Of the rays to it, only those are cast that may differ.
void ColorWriter::shine(std::size_t lamp, const BlockView& view) {
  const Box& points = view.points;
  const Box& reach = by_.reaches[lamp];
  if (!reach.intersects(Box(points.min().array() - kLift, points.max().array() + kLift))) return;
  if (view.is_behind(by_.lamps[lamp].lamp)) return;
  const Sight sight = sights_.of(lamp, points);
  if (sight == Sight::kNone) return;
  for (std::size_t k = 0; k < count_; ++k) {
    Tile& tile = tiles_[k];
    if (!reach.intersects(tile.seen)) continue;
    const Sight part = sight == Sight::kAll ? sight : sights_.of_part(lamp, tile.starts);
    if (part == Sight::kNone) continue;
    const Among among = part == Sight::kAll ? Among{false, false} : sights_.among();
    render::shine(by_.lamps[lamp], instances_, among, tile);
  }
}

}  // namespace angen::render

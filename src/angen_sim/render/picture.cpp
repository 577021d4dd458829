#include "render/picture.h"

#include <algorithm>

namespace angen::render {
namespace {

std::size_t index_of(int width, int column, int row, int lane) {
  return static_cast<std::size_t>(row + lane / kTile) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(column + lane % kTile);
}

void gather(const Instances& instances, const TracedTile& from, const Eigen::Vector3f& ambient,
            Tile& tile) {
  const RTCRayHit16& rays = from.rays;
  tile.column = from.column;
  tile.row = from.row;
  tile.seen.setEmpty();
  tile.lifted.setEmpty();
  for (int i = 0; i < kLanes; ++i) {
    tile.in_image[i] = from.valid[i] != 0;
    tile.valid[i] = from.has_hit(i) ? -1 : 0;
    if (tile.valid[i] == 0) continue;
    const Placed& placed = instances[rays.hit.instID[0][i]];
    const Facet facet = placed.patch->facet(rays.hit.geomID[i], rays.hit.primID[i]);
    const Eigen::Vector3f direction = from.direction(i);
    const Eigen::Vector3f origin(rays.ray.org_x[i], rays.ray.org_y[i], rays.ray.org_z[i]);
    tile.point[i] = origin + rays.ray.tfar[i] * direction;
    tile.normal[i] = placed.rotation * facet.normal;
    if (tile.normal[i].dot(direction) > 0.0F) tile.normal[i] = -tile.normal[i];
    tile.through[i] = placed.shines_through;
    tile.finish[i] = &placed.patch->finish(facet);
    tile.color[i] = placed.patch->color(facet, rays.hit.u[i], rays.hit.v[i]);
    tile.light[i] = ambient;
    tile.seen.extend(tile.point[i]);
    tile.lifted.extend(lifted(tile, i));
  }
}

BlockView view_of(const Tile* tiles, std::size_t count) {
  BlockView view;
  for (std::size_t k = 0; k < count; ++k) {
    const Tile& tile = tiles[k];
    for (int i = 0; i < kLanes; ++i) {
      if (tile.valid[i] != 0) view.add_way(tile.normal[i], tile.through[i]);
    }
    view.points.extend(tile.lifted);
  }
  return view;
}

void show(const Tile& tile, int i, std::uint8_t* pixel) {
  const Finish& finish = *tile.finish[i];
  for (int c = 0; c < 3; ++c) {
    const float reflected = tile.color[i][c] * tile.light[i][c] / static_cast<float>(M_PI);
    pixel[c] = shown(reflected + kMiddleLuminance * finish.emissive[c]);
  }
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
  if (by.ambience.reflected) reflected_.emplace(*by.ambience.reflected, instances.opaque());
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
  for (std::size_t k = 0; k < count_; ++k) {
    const Tile& tile = tiles_[k];
    for (int i = 0; i < kLanes; ++i) {
      if (!tile.in_image[i]) continue;
      std::uint8_t* pixel = pixels_ + 3 * index_of(width_, tile.column, tile.row, i);
      if (tile.valid[i] != 0) {
        show(tile, i, pixel);
      } else {
        for (int c = 0; c < 3; ++c) pixel[c] = shown_as_is(by_.ambience.background[c]);
      }
    }
  }
  count_ = 0;
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
    const Sight part = sight == Sight::kAll ? sight : sights_.of_part(lamp, tile.lifted);
    if (part == Sight::kNone) continue;
    render::shine(by_.lamps[lamp], part == Sight::kAll ? nullptr : instances_.opaque(), tile);
  }
}

}  // namespace angen::render

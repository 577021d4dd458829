#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "render/reflections.h"
#include "render/shade.h"
#include "render/sight.h"
#include "render/tracer.h"

namespace angen::render {

/// Writes the depths of tiles.
class DepthWriter : public Visitor {
 public:
  /// For an image of that width.
  DepthWriter(int width, float* depths) : width_(width), depths_(depths) {}
  void add(const TracedTile& tile) override;

 private:
  int width_;
  float* depths_;
};

/// The light of an image.
struct Illumination {
  const std::vector<light::Lit>& lamps;
  const std::vector<Box>& reaches;  // reaches of the lamps
  const Ambience& ambience;
};

/// The ways that the surfaces at some points face.
struct Facing {
  std::array<Eigen::Vector3f, 4> ways;  // their normals
  std::size_t way_count = 0;
  bool turned = false;  // toward more ways, or to all

  void add(const Eigen::Vector3f& normal, bool through);
  /// True only if the lamp shines on the back of all surfaces, with points in that box.
  bool is_behind(const light::Lamp& lamp, const Box& points) const;
};

/// Writes the colors of tiles, and their depths.
class ColorWriter : public Visitor {
 public:
  ColorWriter(const Instances& instances, const Illumination& by, int width, std::uint8_t* pixels,
              float* depths);
  void begin_row_of_blocks() override;
  void add(const TracedTile& tile) override;
  void end_block() override;

 private:
  void set_squares();
  void shine(std::size_t lamp, std::size_t level, std::size_t square, Sight sight);
  void write(const Tile& tile);

  const Instances& instances_;
  const Illumination& by_;
  int width_;
  std::uint8_t* pixels_;
  DepthWriter depths_;
  Sights sights_;
  std::optional<Reflections> reflected_;
  // State of the present block:
  std::array<Tile, kTiles> tiles_;
  std::array<bool, kTiles> has_{};    // the tile is in the image
  std::array<Box, kSquares> points_;  // lifted off their surfaces; empty without hits
  std::array<Facing, 4> facing_;      // facings of its quarters
};

}  // namespace angen::render

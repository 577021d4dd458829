#pragma once

#include <array>
#include <vector>

#include "light/reflected_light.h"
#include "render/shade.h"

namespace angen::render {

/// Reflected light on blocks of tiles. It varies over decimeters: a square of pixels on a flat
/// piece of up to 0.25 m gets what is interpolated between its corners, and other pixels that of a
/// near point that faces the same way. Blocks of a row come from left to right, and rows share
/// nothing, so that images do not depend on which thread has which rows.
class Reflections {
 public:
  Reflections(const light::ReflectedLight& light, const Instances& instances, int width);

  /// Begins a row of blocks.
  void start();
  /// Adds reflected light to each point of a block's tiles, of those that are in the image.
  void shine(std::array<Tile, kTiles>& tiles, const std::array<bool, kTiles>& has);

 private:
  struct Known {
    Eigen::Vector3f point, normal, light;
  };
  /// What is known of the surfaces at a corner of tiles.
  struct Corner {
    std::array<Known, 4> known;
    std::size_t count = 0;  // count of all that were added; the last ones are there

    const Known* find(const Eigen::Vector3f& point, const Eigen::Vector3f& normal,
                      float within) const;
    void add(const Known& one);
  };
  /// What a square shows.
  struct Piece {
    Eigen::Vector3f point, normal;
    Box box;
    bool is_flat = false;
  };

  void find_flat(const std::array<Tile, kTiles>& tiles);
  void shine(std::array<Tile, kTiles>& tiles, std::size_t square, int across);
  void shine_flat(Tile* tiles, int across);
  void shine_each(Tile& tile);
  Corner& corner(const Tile& tile, int right, int down);
  Eigen::Vector3f at(Corner& corner, const Tile& tile, int pixel);

  light::ReflectedLookup lookup_;
  std::size_t corners_across_;
  std::vector<Corner> corners_;     // corners of the row of blocks
  std::array<bool, kTiles> has_{};  // tiles of the present block that have one
  std::array<Piece, kSquares> pieces_;
};

}  // namespace angen::render

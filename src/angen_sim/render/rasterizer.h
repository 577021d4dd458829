#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/lists.h"
#include "render/eye.h"
#include "render/instances.h"

namespace angen::render {

/// Finds the first faces on a camera's rays without tracing them: faces are linear functions of the
/// pixel (Olano and Greer 1997), and a square of pixels that shows several is divided (Warnock
/// 1969). One for each thread.
class Rasterizer {
 public:
  /// The camera's rays must be linear.
  Rasterizer(const Eye& eye, const Instances& instances) : eye_(eye), instances_(instances) {}

  /// Looks for the faces in view of a square of pixels up to that depth, m. False if fixed ones are
  /// too many, or include a heightmap.
  bool start(int column, int row, int size, float depth);
  /// Whether that mover has too many faces, or a heightmap: its hits are not found.
  bool lacks(std::uint32_t mover) const { return is_in(mover, lacking_); }
  /// Sets the hits of the tiles, in Z-order, of a square of kSquare pixels within the one that was
  /// started. `found` is set to false for a tile with a ray that has no hit up to that depth.
  void find_hits(int column, int row, std::array<TileRays, kTilesOfASquare>& tiles,
                 std::array<bool, kTilesOfASquare>& found);

 private:
  /// A face in view.
  struct InView {
    Face face;  // world
    std::uint32_t instance = 0, triangle = 0;
    bool has_texture = false;
  };
  /// A face as functions of the pixel: their values at the first one, and what a pixel to the right
  /// and one down adds.
  struct Shown {
    Eigen::Array4f inside, inside_right, inside_down;  // >= 0 on the inner side of each edge
    float closeness = 0.0F, closeness_right = 0.0F, closeness_down = 0.0F;  // 1 / depth
    std::uint32_t instance = 0, triangle = 0;
    bool has_texture = false;
  };
  /// Pixels counted from the first one of the square that was started.
  struct Square {
    int x = 0, y = 0, size = 0;
  };
  static constexpr std::size_t kMost = 128;
  struct List {
    std::array<std::uint8_t, kMost> all;
    std::size_t count = 0;
  };

  bool look_for(const Hull& hull, std::uint32_t instance);
  void show(const InView& of);
  void divide(const Square& square, const List& above, std::size_t level, TileRays* tiles,
              bool* found);
  bool choose(const Square& square, const List& from, List& to) const;
  void fill(const Square& tile, const Shown& face, RTCRayHit16& rays) const;
  bool compare(const Square& tile, const List& faces, TileRays& rays) const;
  void set_hit(const Shown& face, float x, float y, int i, float closeness,
               RTCRayHit16& rays) const;

  const Eye& eye_;
  const Instances& instances_;
  // State of the square that was started:
  int column_ = 0, row_ = 0;
  Vec3 first_, right_, down_;                             // directions
  float least_closeness_ = 0.0F, most_closeness_ = 0.0F;  // 1/m
  bool reaches_far_ = false;                              // no ray goes farther
  std::vector<InView> in_view_;
  std::vector<Shown> shown_;
  std::vector<std::uint32_t> lacking_;  // movers
  std::array<List, 4> lists_;           // by level
};

}  // namespace angen::render

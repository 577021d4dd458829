#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <shared_mutex>
#include <unordered_map>
#include <vector>

namespace angen::light {

/// Reflected light on surfaces, in pieces.
class ReflectedLight {
 public:
  struct Piece {
    Eigen::Vector3f position;  // m, world
    Eigen::Vector3f normal;    // unit, on the lit side
    Eigen::Vector3f light;     // lx, r g b
  };

  explicit ReflectedLight(const std::vector<Piece>& pieces);

 private:
  friend class ReflectedLookup;

  /// Some pieces, with the columns of their positions and normals.
  struct Pieces {
    explicit Pieces(std::vector<Piece> from);
    void weigh_alike(const Eigen::Vector3f& point, const Eigen::Vector3f& normal,
                     Eigen::ArrayXf& weights) const;
    void weigh_facing(const Eigen::Vector3f& from, Eigen::ArrayXf& weights) const;

    std::vector<Piece> all;
    Eigen::ArrayX3f positions, normals;
  };
  /// Pieces near cells, found at the first request and kept for later images. Any thread.
  class NearCells {
   public:
    template <class Find>
    std::shared_ptr<const Pieces> at(std::uint64_t cell, const Find& find);

   private:
    std::shared_mutex mutex_;
    std::unordered_map<std::uint64_t, std::shared_ptr<const Pieces>> known_;
  };
  struct Cell {
    std::uint64_t key = 0;
    std::uint32_t first = 0;  // index of its first piece
    std::uint32_t count = 0;
  };
  /// Pieces sorted by cells of a cubic lattice of that step, m.
  struct Lattice {
    Lattice(const std::vector<Piece>& from, float step);
    /// The mean piece for each cell and each axis nearest to normals.
    std::vector<Piece> merged() const;
    template <class Visit>
    void near(const Eigen::AlignedBox3f& box, Visit&& visit) const;

    float step;
    std::vector<Piece> pieces;
    std::vector<Cell> cells;  // ascending
  };

  Lattice fine_;
  Lattice coarse_;
  mutable std::array<NearCells, 8> near_;  // pieces of the same axis, 6 of any, 7 that may face it
};

/// Estimates reflected light at any place. Make one for each thread.
class ReflectedLookup {
 public:
  static constexpr int kMax = 16;  // pieces that count at one place
  /// Which of `count` places of pieces are visible from a point: bit i for to[i].
  using Visible = std::function<std::uint32_t(const Eigen::Vector3f& from,
                                              const Eigen::Vector3f* to, int count)>;

  ReflectedLookup(const ReflectedLight& light, Visible visible)
      : light_(light), visible_(std::move(visible)) {}

  /// lx, r g b, on a surface at `point` (m, world) with that unit normal: the mean of visible
  /// pieces within 0.6 m that face the same way, weighted by distance. If there are none, as on a
  /// person in the middle of a room, that of pieces within 2.4 m that face the point.
  Eigen::Vector3f at(const Eigen::Vector3f& point, const Eigen::Vector3f& normal);

 private:
  using Piece = ReflectedLight::Piece;
  using Pieces = ReflectedLight::Pieces;
  struct Near {
    std::uint64_t cell = 0;
    std::shared_ptr<const Pieces> pieces{};
  };

  template <class Find>
  const Pieces& near(std::size_t which, std::uint64_t cell, const Find& find);
  const Pieces& alike(const Eigen::Vector3f& point, const Eigen::Vector3f& normal);
  const Pieces& around(const Eigen::Vector3f& point);

  const ReflectedLight& light_;
  Visible visible_;
  std::array<Near, 8> last_;  // entries of ReflectedLight::near_
  Eigen::ArrayXf weights_;    // weights of the pieces at one place
};

}  // namespace angen::light

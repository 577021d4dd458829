#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "physics/model.h"

namespace angen::physics {

/// Finds geoms that may touch: cubes of 2 m, and a list of those too large for them (planes). A
/// query costs as much as there are near geoms, whatever the size of the world. Results are
/// unordered.
class Grid {
 public:
  /// Inserts a geom by its box, again after it has moved. One that touches nothing is left out.
  void update(Geom& geom);
  void erase(Geom& geom);

  /// Calls visit(Geom&) once for each other geom whose box overlaps that of `geom`, which is filed.
  template <class F>
  void query(Geom& geom, F&& visit) {
    if (!geom.touches) return;
    ++query_;
    geom.visited = query_;
    const auto check = [&](Geom* other) {
      if (!geom.box.overlaps(other->box) || other->visited == query_) return;
      other->visited = query_;
      visit(*other);
    };
    for (Geom* other : unbounded_) check(other);
    if (geom.unbounded) {
      for (auto& [key, cell] : cells_) {
        for (Geom* other : cell) check(other);
      }
      return;
    }
    if (geom.shared_cells.empty()) find_cells(geom);
    for (const std::vector<Geom*>* cell : geom.shared_cells) {
      for (Geom* other : *cell) check(other);
    }
  }

 private:
  struct Spread {
    std::size_t operator()(std::uint64_t k) const { return k * 0x9e3779b97f4a7c15ULL >> 16; }
  };

  void find_cells(Geom& geom);

  std::unordered_map<std::uint64_t, std::vector<Geom*>, Spread> cells_;
  std::vector<Geom*> unbounded_;
  std::uint64_t query_ = 0;
};

}  // namespace angen::physics

#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

#include "rays/scene.h"

namespace angen::sim {

/// Knows which moving shapes are near each watched region (a box in which a sensor's rays run),
/// and which regions changed since when. A mover is indexed by a box somewhat larger than its own
/// and indexed again only when it has left that box, so the cost of a tick depends on the movers in
/// it, not on the number of regions.
class MoverIndex {
 public:
  using Box = Eigen::AlignedBox3d;
  using Moment = std::uint64_t;  // counts calls of advance()

  struct SplitMovers {
    std::vector<rays::ShapeId> still;
    std::vector<rays::ShapeId> moving;
    Moment longest = 0;  // when the one of `moving` that has rested longest came to rest
  };

  /// A registered region; the destructor removes it, and must run before that of MoverIndex.
  class WatchRegion {
   public:
    WatchRegion(MoverIndex& movers, const Box& box);
    ~WatchRegion();
    WatchRegion(const WatchRegion&) = delete;
    WatchRegion& operator=(const WatchRegion&) = delete;

    void resize(const Box& box);
    /// Moving shapes that may be in the box; in no particular order, each once.
    const std::vector<rays::ShapeId>& near() const;
    /// near() in two: movers that have neither moved nor come at `since` or later, and the others.
    void split(Moment since, SplitMovers& split) const;
    /// Whether any of them has moved, been added or removed at `since` or later.
    bool changed_since(Moment since) const { return movers_.changed_since(index_, since); }
    /// The region's number for MoverIndex::changed_since(), valid until the box changes; UINT32_MAX
    /// where each_changed_since() cannot find it.
    std::uint32_t number() const {
      return movers_.region_states_[index_].cell_list != 0 ? index_ : UINT32_MAX;
    }
    /// Whether static shapes in it came or went since the last call.
    bool take_static_change();

   private:
    MoverIndex& movers_;
    std::uint32_t index_;
  };

  /// Whether WatchRegion::changed_since() of the region with that number, or a surface in it was
  /// set to another temperature.
  bool changed_or_warmed_since(std::uint32_t region, Moment since) const {
    return region_states_[region].warmed >= since || changed_since(region, since);
  }
  std::size_t region_count() const { return regions_.size(); }  // numbers are below it
  /// Calls visit(number) for each region that changed at `since` or later, and for others near
  /// them, for some more than once.
  template <class F>
  void each_changed_since(Moment since, F&& visit) const {
    if (wide_changed_ >= since) {
      for (std::uint32_t region = 0; region < regions_.size(); ++region) visit(region);
      return;
    }
    for (std::uint32_t cell = latest_; cell != UINT32_MAX && cells_[cell].changed >= since;
         cell = cells_[cell].before) {
      for (const std::uint32_t region : cells_[cell].regions) visit(region);
    }
  }

  /// A moving shape came or moved; its box (m) is infinite for a plane, empty if it cannot be
  /// hit.
  void put(rays::ShapeId mover, const Box& box);
  void remove(rays::ShapeId mover);
  /// A static shape of this box was added or is removed.
  void change_static(const Box& box);
  /// A shape of this box was set to another temperature.
  void warm(const Box& box);

  /// Starts the next moment: later changes get a larger one.
  void advance() { ++now_; }
  Moment now() const { return now_; }

 private:
  struct Region {
    std::vector<rays::ShapeId> near;
    bool used = false;
    std::uint64_t visited = 0;
    Box box;
  };
  // The part of a region that is checked first; apart from the rest, which would cause a cache miss
  // for each of many regions.
  struct RegionState {
    Moment left = 0;              // when a mover was last removed from its list
    Moment warmed = 0;            // when a surface in it was last set to another temperature
    std::uint32_t cell_list = 0;  // in cell_lists_; 0 for a region in too many cells
    bool static_change = false;
  };
  using CellList = std::vector<std::uint32_t>;  // numbers of cells
  /// Cells form a list from the most recently changed one on.
  struct Cell {
    std::vector<std::uint32_t> regions;
    Moment changed = 0;  // when a mover in it moved, or other shapes near a region in it changed
    std::uint32_t before = UINT32_MAX;
    std::uint32_t after = UINT32_MAX;
  };
  struct Mover {
    rays::ShapeId id;
    Box box;  // larger than its own
    bool wide = false;
    CellList cells;
    std::vector<std::uint32_t> regions;
  };

  bool changed_since(std::uint32_t region, Moment since) const;
  void mark_changed(std::uint32_t cell);
  void mark_changed(const Mover& mover);
  std::uint32_t open(const Box& box);
  void close(std::uint32_t region);
  void add_to_cells(std::uint32_t region);
  void remove_from_cells(std::uint32_t region);
  /// The cells that a box overlaps; false if they are too many.
  bool find_cells(const Box& box, CellList& cells);
  void link(Mover& mover);
  void unlink(Mover& mover);
  template <class F>
  void each_region_in(const Box& box, F&& visit);

  std::vector<Region> regions_;
  std::vector<RegionState> region_states_;  // indexed like regions_
  std::vector<CellList> cell_lists_{CellList{}};
  std::map<CellList, std::uint32_t> cell_list_numbers_;
  std::vector<std::uint32_t> free_;
  std::vector<Mover> movers_;  // by index of the shape; one without an id is none
  std::vector<Moment> moved_;  // indexed like movers_, which are too large for this search
  std::unordered_map<std::uint64_t, std::uint32_t> cell_numbers_;  // by packed cell coordinates
  std::vector<Cell> cells_;
  std::uint32_t latest_ = UINT32_MAX;  // the head of their list
  Moment wide_changed_ = 0;            // when a mover in too many cells moved
  std::vector<std::uint32_t> wide_;
  Moment now_ = 1;
  std::uint64_t query_ = 0;
};

}  // namespace angen::sim

#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <memory>
#include <unordered_map>
#include <vector>

#include "rays/scene.h"

namespace angen::sim {

/// Which moving shapes each view may meet, a view being a box in which rays run. A mover is filed
/// by a box somewhat larger than its own and looked for anew only when it has left that, so that a
/// tick costs what moved in it, whatever the number of views.
class Sights {
 public:
  using Box = Eigen::AlignedBox3d;
  using Moment = std::uint64_t;  // counts calls of pass()

  struct Parted {
    std::vector<rays::ShapeId> still;
    std::vector<rays::ShapeId> moving;
    Moment longest = 0;  // of `moving`, when the one that rests for the longest time came to rest
  };

  /// A view's place among the others; gives it up at its end, which must come before that of
  /// Sights.
  class View {
   public:
    View(Sights& sights, const Box& box);
    ~View();
    View(const View&) = delete;
    View& operator=(const View&) = delete;

    void resize(const Box& box);
    /// Moving shapes that may be in the box; in no particular order, each once.
    const std::vector<rays::ShapeId>& near() const;
    /// near() in two: those that have not moved or come at `since` or later, and the others.
    void part(Moment since, Parted& parted) const;
    /// Whether any of them has moved, come or gone at `since` or later.
    bool stirred(Moment since) const { return sights_.stirred(index_, since); }
    /// For stirred() of Sights, until the box changes; none where each_stirred() cannot find it.
    std::uint32_t number() const {
      return sights_.glances_[index_].region != 0 ? index_ : UINT32_MAX;
    }
    /// Whether static shapes in it came or went; forgets it.
    bool take_altered();

   private:
    Sights& sights_;
    std::uint32_t index_;
  };

  /// As View::stirred, of the view with that number.
  bool stirred(std::uint32_t view, Moment since) const;
  std::size_t view_count() const { return views_.size(); }  // numbers are below it
  /// Visits (number) the views that stirred() at `since` or later, and others near them, some more
  /// than once.
  template <class F>
  void each_stirred(Moment since, F&& visit) const {
    if (stirred_wide_ >= since) {
      for (std::uint32_t view = 0; view < views_.size(); ++view) visit(view);
      return;
    }
    for (std::uint32_t cell = latest_; cell != UINT32_MAX && cells_[cell].stirred >= since;
         cell = cells_[cell].before) {
      for (const std::uint32_t view : cells_[cell].views) visit(view);
    }
  }

  /// A moving shape came or moved; its box (m) is infinite for a plane, empty where it cannot be
  /// met.
  void put(rays::ShapeId mover, const Box& box);
  void drop(rays::ShapeId mover);
  /// A static shape of this box came or goes.
  void alter(const Box& box);

  /// What happens from now on is later than all before.
  void pass() { ++now_; }
  Moment now() const { return now_; }

 private:
  struct Place {
    std::vector<rays::ShapeId> near;
    bool used = false;
    std::uint64_t visited = 0;
    Box box;
  };
  // What is looked at first of a view; apart from the rest, since with many views that comes from
  // far away.
  struct Glance {
    Moment left = 0;           // when a mover was last taken off its list
    std::uint32_t region = 0;  // in regions_; the first for those that no cells are known of
    bool altered = false;
  };
  using Region = std::vector<std::uint32_t>;  // numbers of cells
  /// A list of them runs from the one in which something stirred last.
  struct Cell {
    std::vector<std::uint32_t> views;
    Moment stirred = 0;  // when a mover that was or is there moved, or a view there was altered
    std::uint32_t before = UINT32_MAX;
    std::uint32_t after = UINT32_MAX;
  };
  struct Mover {
    rays::ShapeId id;
    Box box;  // larger than its own
    bool wide = false;
    Region cells;
    std::vector<std::uint32_t> views;
  };

  void stir(std::uint32_t cell);
  void stir(const Mover& mover);
  std::uint32_t open(const Box& box);
  void close(std::uint32_t view);
  void file(std::uint32_t view);
  void unfile(std::uint32_t view);
  /// The cells that a box is in; false where it is in too many.
  bool find_cells(const Box& box, Region& cells);
  void link(Mover& mover);
  void unlink(Mover& mover);
  template <class F>
  void each_view_in(const Box& box, F&& visit);

  std::vector<Place> views_;
  std::vector<Glance> glances_;  // as views_
  std::vector<Region> regions_{Region{}};
  std::map<Region, std::uint32_t> region_numbers_;
  std::vector<std::uint32_t> free_;
  std::vector<Mover> movers_;  // by index of the shape; one without an id is none
  std::vector<Moment> moved_;  // as movers_, which are too large to be gone through for it
  std::unordered_map<std::uint64_t, std::uint32_t> cell_numbers_;  // by place
  std::vector<Cell> cells_;
  std::uint32_t latest_ = UINT32_MAX;  // the head of their list
  Moment stirred_wide_ = 0;            // when a mover in too many cells moved
  std::vector<std::uint32_t> wide_;
  Moment now_ = 1;
  std::uint64_t query_ = 0;
};

}  // namespace angen::sim

#include "sim/mover_index.h"

#include <algorithm>
#include <utility>

#include "core/cells.h"

namespace angen::sim {

namespace {

constexpr double kCell = 4.0;       // m
constexpr double kSlack = 0.25;     // m, that a mover's box is larger by, on each side
constexpr double kManyCells = 512;  // a box in more is checked in each query

bool cells_of(const MoverIndex::Box& box, CellRange& cells) {
  return find_cells(box.min(), box.max(), kCell, kCellLimit, kManyCells, cells);
}

// Keeps the order: the oldest is mostly removed first, and is then found at once.
template <class T>
void take_out(std::vector<T>& list, const T& value) {
  const auto at = std::find(list.begin(), list.end(), value);
  if (at != list.end()) list.erase(at);
}

MoverIndex::Box wider(const MoverIndex::Box& box) {
  return {box.min().array() - kSlack, box.max().array() + kSlack};
}

}  // namespace

MoverIndex::WatchRegion::WatchRegion(MoverIndex& movers, const Box& box)
    : movers_(movers), index_(movers.open(box)) {}

MoverIndex::WatchRegion::~WatchRegion() { movers_.close(index_); }

void MoverIndex::WatchRegion::resize(const Box& box) {
  movers_.close(index_);
  index_ = movers_.open(box);
}

const std::vector<rays::ShapeId>& MoverIndex::WatchRegion::near() const {
  return movers_.regions_[index_].near;
}

void MoverIndex::WatchRegion::split(Moment since, SplitMovers& split) const {
  split.still.clear();
  split.moving.clear();
  split.longest = movers_.now_;
  for (const rays::ShapeId id : near()) {
    const Moment moved = movers_.moved_[id.index];
    (moved < since ? split.still : split.moving).push_back(id);
    if (moved >= since) split.longest = std::min(split.longest, moved);
  }
}

bool MoverIndex::changed_since(std::uint32_t region, Moment since) const {
  const RegionState& state = region_states_[region];
  if (state.static_change || state.left >= since) return true;
  if (state.cell_list != 0 && wide_changed_ < since) {
    const CellList& cell_list = cell_lists_[state.cell_list];
    const bool unchanged =
        std::none_of(cell_list.begin(), cell_list.end(),
                     [&](std::uint32_t cell) { return cells_[cell].changed >= since; });
    if (unchanged) return false;
  }
  const std::vector<rays::ShapeId>& near = regions_[region].near;
  return std::any_of(near.begin(), near.end(),
                     [&](rays::ShapeId mover) { return moved_[mover.index] >= since; });
}

bool MoverIndex::WatchRegion::take_static_change() {
  return std::exchange(movers_.region_states_[index_].static_change, false);
}

template <class F>
void MoverIndex::each_region_in(const Box& box, F&& visit) {
  ++query_;
  const auto check = [&](std::uint32_t region) {
    Region& found = regions_[region];
    if (found.visited == query_) return;
    found.visited = query_;
    if (found.box.intersects(box)) visit(region, found);
  };
  for (const std::uint32_t region : wide_) check(region);
  CellRange cells{};
  if (!cells_of(box, cells)) {
    for (std::uint32_t region = 0; region < regions_.size(); ++region) {
      if (regions_[region].used) check(region);
    }
    return;
  }
  each_cell(cells, [&](std::uint64_t key) {
    const auto cell = cell_numbers_.find(key);
    if (cell == cell_numbers_.end()) return;
    for (const std::uint32_t region : cells_[cell->second].regions) check(region);
  });
}

std::uint32_t MoverIndex::open(const Box& box) {
  std::uint32_t region = static_cast<std::uint32_t>(regions_.size());
  if (free_.empty()) {
    regions_.emplace_back();
    region_states_.emplace_back();
  } else {
    region = free_.back();
    free_.pop_back();
  }
  regions_[region].box = box;
  regions_[region].used = true;
  if (box.isEmpty()) return region;
  add_to_cells(region);
  for (Mover& mover : movers_) {
    if (!mover.id.valid() || !mover.box.intersects(box)) continue;
    mover.regions.push_back(region);
    regions_[region].near.push_back(mover.id);
  }
  return region;
}

void MoverIndex::close(std::uint32_t region) {
  remove_from_cells(region);
  for (const rays::ShapeId mover : regions_[region].near)
    take_out(movers_[mover.index].regions, region);
  regions_[region] = {};
  region_states_[region] = {};
  free_.push_back(region);
}

bool MoverIndex::find_cells(const Box& box, std::vector<std::uint32_t>& numbers) {
  numbers.clear();
  CellRange cells{};
  if (!cells_of(box, cells)) return false;
  each_cell(cells, [&](std::uint64_t key) {
    const auto count = static_cast<std::uint32_t>(cells_.size());
    const auto [at, is_new] = cell_numbers_.emplace(key, count);
    if (is_new) cells_.emplace_back();
    numbers.push_back(at->second);
  });
  return true;
}

void MoverIndex::add_to_cells(std::uint32_t region) {
  CellList cells;
  if (!find_cells(regions_[region].box, cells)) {
    wide_.push_back(region);
    return;
  }
  for (const std::uint32_t cell : cells) cells_[cell].regions.push_back(region);
  const auto count = static_cast<std::uint32_t>(cell_lists_.size());
  const auto [at, is_new] = cell_list_numbers_.emplace(cells, count);
  if (is_new) cell_lists_.push_back(std::move(cells));
  region_states_[region].cell_list = at->second;
}

void MoverIndex::remove_from_cells(std::uint32_t region) {
  if (regions_[region].box.isEmpty()) return;
  const std::uint32_t cell_list = region_states_[region].cell_list;
  if (cell_list == 0) take_out(wide_, region);
  for (const std::uint32_t cell : cell_lists_[cell_list]) take_out(cells_[cell].regions, region);
}

void MoverIndex::link(Mover& mover) {
  each_region_in(mover.box, [&](std::uint32_t number, Region& region) {
    mover.regions.push_back(number);
    region.near.push_back(mover.id);
  });
}

void MoverIndex::unlink(Mover& mover) {
  for (const std::uint32_t region : mover.regions) {
    take_out(regions_[region].near, mover.id);
    region_states_[region].left = now_;
  }
  mover.regions.clear();
}

/// Moves the cell to the head of the list.
void MoverIndex::mark_changed(std::uint32_t number) {
  Cell& cell = cells_[number];
  if (cell.changed == now_) return;  // another shape of the same body did it
  cell.changed = now_;
  if (latest_ == number) return;
  if (cell.after != UINT32_MAX) cells_[cell.after].before = cell.before;
  if (cell.before != UINT32_MAX) cells_[cell.before].after = cell.after;
  cell.after = UINT32_MAX;
  cell.before = latest_;
  if (latest_ != UINT32_MAX) cells_[latest_].after = number;
  latest_ = number;
}

void MoverIndex::mark_changed(const Mover& mover) {
  if (mover.wide) wide_changed_ = now_;
  for (const std::uint32_t cell : mover.cells) mark_changed(cell);
}

void MoverIndex::put(rays::ShapeId id, const Box& box) {
  if (box.isEmpty()) {
    remove(id);
    return;
  }
  if (movers_.size() <= id.index) {
    movers_.resize(id.index + 1);
    moved_.resize(id.index + 1);
  }
  Mover& mover = movers_[id.index];
  moved_[id.index] = now_;
  if (mover.id != id || !mover.box.contains(box)) {
    mark_changed(mover);
    unlink(mover);
    mover.id = id;
    mover.box = wider(box);
    mover.wide = !find_cells(mover.box, mover.cells);
    link(mover);
  }
  mark_changed(mover);
}

void MoverIndex::remove(rays::ShapeId id) {
  if (movers_.size() <= id.index || movers_[id.index].id != id) return;
  Mover& mover = movers_[id.index];
  mark_changed(mover);
  unlink(mover);
  mover = {};
}

void MoverIndex::change_static(const Box& box) {
  if (box.isEmpty()) return;
  each_region_in(box, [&](std::uint32_t region, Region&) {
    region_states_[region].static_change = true;
    for (const std::uint32_t cell : cell_lists_[region_states_[region].cell_list])
      mark_changed(cell);
  });
}

void MoverIndex::warm(const Box& box) {
  if (box.isEmpty()) return;
  each_region_in(box, [&](std::uint32_t region, Region&) {
    region_states_[region].warmed = now_;
    for (const std::uint32_t cell : cell_lists_[region_states_[region].cell_list])
      mark_changed(cell);
  });
}

}  // namespace angen::sim

#include "sim/sights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace angen::sim {

namespace {

constexpr double kCell = 4.0;       // m
constexpr double kSlack = 0.25;     // m, that a mover's box is larger by, on each side
constexpr double kManyCells = 512;  // a box in more is looked at in each query
constexpr double kFarthestReach = 1 << 20;

using Cells = std::array<int, 6>;  // first and last along x, y, z

bool cells_of(const Sights::Box& box, Cells& cells) {
  double count = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double first = std::floor(box.min()[axis] / kCell);
    const double last = std::floor(box.max()[axis] / kCell);
    if (!(first > -kFarthestReach && last < kFarthest)) return false;
    count *= last - first + 1.0;
    cells[2 * axis] = static_cast<int>(first);
    cells[2 * axis + 1] = static_cast<int>(last);
  }
  return count <= kManyCells;
}

template <class F>
void each_cell(const Cells& cells, F&& visit) {
  const auto part = [](int v) { return static_cast<std::uint64_t>(v + (1 << 20)) & 0x1fffff; };
  for (int x = cells[0]; x <= cells[1]; ++x) {
    for (int y = cells[2]; y <= cells[3]; ++y) {
      for (int z = cells[4]; z <= cells[5]; ++z) visit(part(x) << 42 | part(y) << 21 | part(z));
    }
  }
}

// Keeps the order: what came first mostly goes first, and is then found at once.
template <class T>
void take_out(std::vector<T>& list, const T& value) {
  const auto at = std::find(list.begin(), list.end(), value);
  if (at != list.end()) list.erase(at);
}

Sights::Box wider(const Sights::Box& box) {
  return {box.min().array() - kSlack, box.max().array() + kSlack};
}

}  // namespace

Sights::View::View(Sights& sights, const Box& box) : sights_(sights), index_(sights.open(box)) {}

Sights::View::~View() { sights_.close(index_); }

void Sights::View::resize(const Box& box) {
  sights_.close(index_);
  index_ = sights_.open(box);
}

const std::vector<rays::ShapeId>& Sights::View::near() const { return sights_.views_[index_].near; }

void Sights::View::part(Moment since, Parted& parted) const {
  parted.still.clear();
  parted.moving.clear();
  parted.longest = sights_.now_;
  for (const rays::ShapeId id : near()) {
    const Moment moved = sights_.moved_[id.index];
    (moved < since ? parted.still : parted.moving).push_back(id);
    if (moved >= since) parted.longest = std::min(parted.longest, moved);
  }
}

bool Sights::stirred(std::uint32_t view, Moment since) const {
  const Glance& glance = glances_[view];
  if (glance.altered || glance.left >= since) return true;
  if (glance.region != 0 && stirred_wide_ < since) {
    const Region& region = regions_[glance.region];
    const bool calm = std::none_of(region.begin(), region.end(), [&](std::uint32_t cell) {
      return cells_[cell].stirred >= since;
    });
    if (calm) return false;
  }
  const std::vector<rays::ShapeId>& near = views_[view].near;
  return std::any_of(near.begin(), near.end(),
                     [&](rays::ShapeId mover) { return moved_[mover.index] >= since; });
}

bool Sights::View::take_altered() { return std::exchange(sights_.glances_[index_].altered, false); }

template <class F>
void Sights::each_view_in(const Box& box, F&& visit) {
  ++query_;
  const auto look = [&](std::uint32_t view) {
    Place& place = views_[view];
    if (place.visited == query_) return;
    place.visited = query_;
    if (place.box.intersects(box)) visit(view, place);
  };
  for (const std::uint32_t view : wide_) look(view);
  Cells cells{};
  if (!cells_of(box, cells)) {
    for (std::uint32_t view = 0; view < views_.size(); ++view) {
      if (views_[view].used) look(view);
    }
    return;
  }
  each_cell(cells, [&](std::uint64_t key) {
    const auto cell = cell_numbers_.find(key);
    if (cell == cell_numbers_.end()) return;
    for (const std::uint32_t view : cells_[cell->second].views) look(view);
  });
}

std::uint32_t Sights::open(const Box& box) {
  std::uint32_t view = static_cast<std::uint32_t>(views_.size());
  if (free_.empty()) {
    views_.emplace_back();
    glances_.emplace_back();
  } else {
    view = free_.back();
    free_.pop_back();
  }
  views_[view].box = box;
  views_[view].used = true;
  if (box.isEmpty()) return view;
  file(view);
  for (Mover& mover : movers_) {
    if (!mover.id.valid() || !mover.box.intersects(box)) continue;
    mover.views.push_back(view);
    views_[view].near.push_back(mover.id);
  }
  return view;
}

void Sights::close(std::uint32_t view) {
  unfile(view);
  for (const rays::ShapeId mover : views_[view].near) take_out(movers_[mover.index].views, view);
  views_[view] = {};
  glances_[view] = {};
  free_.push_back(view);
}

bool Sights::find_cells(const Box& box, std::vector<std::uint32_t>& numbers) {
  numbers.clear();
  Cells cells{};
  if (!cells_of(box, cells)) return false;
  each_cell(cells, [&](std::uint64_t key) {
    const auto count = static_cast<std::uint32_t>(cells_.size());
    const auto [at, is_new] = cell_numbers_.emplace(key, count);
    if (is_new) cells_.emplace_back();
    numbers.push_back(at->second);
  });
  return true;
}

void Sights::file(std::uint32_t view) {
  Region cells;
  if (!find_cells(views_[view].box, cells)) {
    wide_.push_back(view);
    return;
  }
  for (const std::uint32_t cell : cells) cells_[cell].views.push_back(view);
  const auto count = static_cast<std::uint32_t>(regions_.size());
  const auto [at, is_new] = region_numbers_.emplace(cells, count);
  if (is_new) regions_.push_back(std::move(cells));
  glances_[view].region = at->second;
}

void Sights::unfile(std::uint32_t view) {
  if (views_[view].box.isEmpty()) return;
  const std::uint32_t region = glances_[view].region;
  if (region == 0) take_out(wide_, view);
  for (const std::uint32_t cell : regions_[region]) take_out(cells_[cell].views, view);
}

void Sights::link(Mover& mover) {
  each_view_in(mover.box, [&](std::uint32_t view, Place& place) {
    mover.views.push_back(view);
    place.near.push_back(mover.id);
  });
}

void Sights::unlink(Mover& mover) {
  for (const std::uint32_t view : mover.views) {
    take_out(views_[view].near, mover.id);
    glances_[view].left = now_;
  }
  mover.views.clear();
}

/// Puts it at the head of the list.
void Sights::stir(std::uint32_t number) {
  Cell& cell = cells_[number];
  cell.stirred = now_;
  if (latest_ == number) return;
  if (cell.after != UINT32_MAX) cells_[cell.after].before = cell.before;
  if (cell.before != UINT32_MAX) cells_[cell.before].after = cell.after;
  cell.after = UINT32_MAX;
  cell.before = latest_;
  if (latest_ != UINT32_MAX) cells_[latest_].after = number;
  latest_ = number;
}

void Sights::stir(const Mover& mover) {
  if (mover.wide) stirred_wide_ = now_;
  for (const std::uint32_t cell : mover.cells) stir(cell);
}

void Sights::put(rays::ShapeId id, const Box& box) {
  if (box.isEmpty()) {
    drop(id);
    return;
  }
  if (movers_.size() <= id.index) {
    movers_.resize(id.index + 1);
    moved_.resize(id.index + 1);
  }
  Mover& mover = movers_[id.index];
  moved_[id.index] = now_;
  if (mover.id != id || !mover.box.contains(box)) {
    stir(mover);
    unlink(mover);
    mover.id = id;
    mover.box = wider(box);
    mover.wide = !find_cells(mover.box, mover.cells);
    link(mover);
  }
  stir(mover);
}

void Sights::drop(rays::ShapeId id) {
  if (movers_.size() <= id.index || movers_[id.index].id != id) return;
  Mover& mover = movers_[id.index];
  stir(mover);
  unlink(mover);
  mover = {};
}

void Sights::alter(const Box& box) {
  if (box.isEmpty()) return;
  each_view_in(box, [&](std::uint32_t view, Place&) {
    glances_[view].altered = true;
    for (const std::uint32_t cell : regions_[glances_[view].region]) stir(cell);
  });
}

}  // namespace angen::sim

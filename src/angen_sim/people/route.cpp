#include "people/route.h"

#include <algorithm>

namespace angen::people {

namespace {

constexpr std::size_t kSearch = 60;  // places ahead: 3 to 4 m
constexpr std::size_t kLook = 45;    // places that it may make for
constexpr std::size_t kNext = 16;    // places: 0.8 to 1.1 m

}  // namespace

Route::Route(FloorMap map, std::vector<Vec2> way)
    : map_(std::move(map)), way_(std::move(way)), left_(way_.size(), 0.0) {
  for (std::size_t i = way_.size() - 1; i-- > 0;) {
    left_[i] = left_[i + 1] + (way_[i + 1] - way_[i]).norm();
  }
}

Route::Vec2 Route::follow(const Vec2& at) {
  const std::size_t end = std::min(way_.size(), next_ + kSearch);
  std::size_t nearest = next_;
  for (std::size_t i = next_; i < end; ++i) {
    if ((way_[i] - at).norm() < (way_[nearest] - at).norm()) nearest = i;
  }
  next_ = nearest;
  for (std::size_t i = std::min(way_.size() - 1, next_ + kLook); i > next_; --i) {
    if (map_.is_clear(at, way_[i])) return way_[i];
  }
  return way_[std::min(way_.size() - 1, next_ + 2)];
}

std::vector<Route::Vec2> Route::next() const {
  const auto from = way_.begin() + static_cast<std::ptrdiff_t>(next_);
  return {from, from + static_cast<std::ptrdiff_t>(std::min(kNext, way_.size() - next_))};
}

double Route::left(const Vec2& at) const { return left_[next_] + (way_[next_] - at).norm(); }

}  // namespace angen::people

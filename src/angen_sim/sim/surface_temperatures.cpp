#include "sim/surface_temperatures.h"

#include <algorithm>
#include <cmath>

#include "core/lists.h"

namespace angen::sim {

void SurfaceTemperatures::set(rays::ShapeId shape, double temperature, double limit,
                              double time_constant, Nanoseconds now, Moment moment) {
  remove(shape);
  note_changed(shape, moment).set = set_ = moment;
  ++times_set_;
  const bool changes = time_constant > 0.0 && std::abs(temperature - limit) >= Warming::kArrived;
  const Warming course =
      changes ? Warming{temperature, limit, time_constant, now} : Warming::constant(limit);
  rays_.warm(shape, course);
  if (changes) changing_.push_back({shape, course});
}

void SurfaceTemperatures::remove(rays::ShapeId shape) {
  erase_if(changing_, [&](const Changing& each) { return each.shape == shape; });
  erase_if(changes_, [&](const Change& each) { return each.shape == shape; });
}

SurfaceTemperatures::Change& SurfaceTemperatures::note_changed(rays::ShapeId shape, Moment moment) {
  changed_ = moment;
  const auto known = std::find_if(changes_.begin(), changes_.end(),
                                  [&](const Change& each) { return each.shape == shape; });
  if (known == changes_.end()) {
    changes_.push_back({shape, moment, 0});
  } else {
    std::rotate(known, known + 1, changes_.end());
    changes_.back().moment = moment;
  }
  return changes_.back();
}

template <class Test>
bool SurfaceTemperatures::any_changed(Moment since, const Test& test) const {
  for (auto each = changes_.rbegin(); each != changes_.rend() && each->moment >= since; ++each) {
    if (test(*each)) return true;
  }
  return false;
}

bool SurfaceTemperatures::changed_since(Moment since, const Eigen::AlignedBox3d& within) const {
  if (!changed_since(since)) return false;
  const auto inside = [&](rays::ShapeId shape) { return rays_.bounds(shape).intersects(within); };
  const auto changes = [&](const Changing& each) { return inside(each.shape); };
  return std::any_of(changing_.begin(), changing_.end(), changes) ||
         any_changed(since, [&](const Change& each) { return inside(each.shape); });
}

bool SurfaceTemperatures::set_since(Moment since, const Eigen::AlignedBox3d& within) const {
  return set_since(since) && any_changed(since, [&](const Change& each) {
           return each.set >= since && rays_.bounds(each.shape).intersects(within);
         });
}

void SurfaceTemperatures::advance(Nanoseconds now, Moment moment) {
  for (Changing& each : changing_) {
    each.arrived = each.course.at(now) == each.course.limit;
    if (!each.arrived) continue;
    rays_.warm(each.shape, Warming::constant(each.course.limit));
    note_changed(each.shape, moment);
  }
  erase_if(changing_, [](const Changing& each) { return each.arrived; });
}

}  // namespace angen::sim

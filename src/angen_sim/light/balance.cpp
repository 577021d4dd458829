#include "light/balance.h"

#include <algorithm>
#include <utility>

namespace angen::light {

bool any_in(const Eigen::AlignedBox3d& box, const std::vector<Changes::Moved>& moved) {
  return std::any_of(moved.begin(), moved.end(),
                     [&](const Changes::Moved& each) { return box.intersects(each.box); });
}

Balance balance(Balance before, const Request& request) {
  Balance now{std::move(before.field), {}};
  now.field.update(request.scene, request.moved);
  std::vector<Unsolved> unsolved;
  std::vector<std::size_t> places;  // in `now.solved`
  for (const Request::Of& of : request.lamps) {
    const auto known = std::find_if(
        before.solved.begin(), before.solved.end(),
        [&](const Solved& each) { return each.id == of.id && each.version == of.version; });
    const Solution* old = known == before.solved.end() ? nullptr : known->solution.get();
    if (old != nullptr && !any_in(old->bounds, request.moved)) {
      now.solved.push_back(*known);
    } else if (of.lit) {
      places.push_back(now.solved.size());
      now.solved.push_back({of.id, of.version, nullptr});
      unsolved.push_back({of.lamp, old, request.moved});
    }
  }
  std::vector<std::shared_ptr<const Solution>> solutions = solve(unsolved, now.field);
  for (std::size_t i = 0; i < places.size(); ++i) {
    now.solved[places[i]].solution = std::move(solutions[i]);
  }
  return now;
}

}  // namespace angen::light

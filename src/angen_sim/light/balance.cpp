#include "light/balance.h"

#include <algorithm>
#include <utility>

namespace angen::light {
namespace {

constexpr std::size_t kMostAhead = 100000;  // patches, some 100 MB that may never be needed

const Solved* find(const std::vector<Solved>& among, const Request::Of& of) {
  const auto found = std::find_if(among.begin(), among.end(), [&](const Solved& each) {
    return each.id == of.id && each.version == of.version;
  });
  return found == among.end() ? nullptr : &*found;
}

}  // namespace

bool any_in(const Eigen::AlignedBox3d& box, const std::vector<Changes::Moved>& moved) {
  return std::any_of(moved.begin(), moved.end(),
                     [&](const Changes::Moved& each) { return box.intersects(each.box); });
}

Balance balance(Balance before, const Request& request) {
  Balance now{std::move(before.field), {}, {}};
  now.field.update(request.scene, request.moved);
  std::vector<Unsolved> unsolved;
  std::vector<std::size_t> places;  // in `now.solved`
  for (const Request::Of& of : request.lamps) {
    const Solved* known = find(before.solved, of);
    const Solved* ahead = find(before.ahead, of);
    const Solved* either = known != nullptr ? known : ahead;
    const Solution* old = either == nullptr ? nullptr : either->solution.get();
    const bool holds = old != nullptr && !any_in(old->bounds, request.moved);
    if (holds && (known != nullptr || of.lit)) {
      now.solved.push_back(*either);
    } else if (of.lit) {
      places.push_back(now.solved.size());
      now.solved.push_back({of.id, of.version, nullptr});
      unsolved.push_back({of.lamp, old, request.moved});
    } else if (ahead != nullptr) {
      now.ahead.push_back({of.id, of.version, holds ? ahead->solution : nullptr});
    }
  }
  std::vector<std::shared_ptr<const Solution>> solutions = solve(unsolved, now.field);
  for (std::size_t i = 0; i < places.size(); ++i) {
    now.solved[places[i]].solution = std::move(solutions[i]);
  }
  return now;
}

LookAhead::LookAhead(Balance from, std::vector<Request::Of> lamps)
    : result_(std::async(std::launch::async,
                         [this, all = std::move(from), of = std::move(lamps)]() mutable {
                           for (const Request::Of& each : of) {
                             if (stop_ || all.field.size() > kMostAhead) break;
                             auto solution = solve(each.lamp, all.field, stop_);
                             if (solution)
                               all.ahead.push_back({each.id, each.version, std::move(solution)});
                           }
                           return std::move(all);
                         })) {}

}  // namespace angen::light

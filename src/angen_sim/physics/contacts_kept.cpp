// Contacts that are kept: of watched geoms, and of bodies that sleep.
#include <algorithm>
#include <utility>

#include "physics/contacts.h"

namespace angen::physics {

namespace {

/// Turned so that `geom`, one of the two, is the first.
ContactPair seen_from(const Geom& geom, const Geom& first, const Geom& second,
                      std::vector<ContactPoint> points) {
  if (&first == &geom) return {first.name, second.name, std::move(points)};
  for (ContactPoint& point : points) {
    point.normal = -point.normal;
    point.force = -point.force;
  }
  return {second.name, first.name, std::move(points)};
}

}  // namespace

void Contacts::remember(std::int64_t tick) {
  for (const Pair& pair : pairs_) {
    for (auto [one, other] :
         {std::pair(pair.first, pair.second), std::pair(pair.second, pair.first)}) {
      if (!one->watched) continue;
      one->recent[other->serial] = {tick,
                                    seen_from(*one, *pair.first, *pair.second, points_of(pair))};
    }
  }
}

std::vector<ContactPair> Contacts::with_recent(Geom& geom, std::int64_t first,
                                               std::vector<ContactPair> now) {
  geom.watched = true;
  const std::size_t current = now.size();
  for (auto at = geom.recent.begin(); at != geom.recent.end();) {
    if (at->second.tick < first) {
      at = geom.recent.erase(at);
      continue;
    }
    const ContactPair& pair = (at++)->second.pair;
    const auto end = now.begin() + static_cast<std::ptrdiff_t>(current);
    const bool touches = std::any_of(
        now.begin(), end, [&](const ContactPair& each) { return each.second == pair.second; });
    if (!touches) now.push_back(pair);
  }
  return now;
}

void Contacts::put_to_rest() {
  const auto asleep = [](const Pair& pair) {
    return !pair.first->body->awake && !pair.second->body->awake;
  };
  for (const Pair& pair : pairs_) {
    if (!asleep(pair)) continue;
    const PairKey key = key_of(pair);
    resting_[key] = {pair.first, pair.second, points_of(pair)};
    with_smaller_.emplace(key.second, key.first);
    for (Body* body : {pair.first->body, pair.second->body}) {
      if (body->dynamic()) body->resting.push_back(key);
    }
  }
  pairs_.erase(std::remove_if(pairs_.begin(), pairs_.end(), asleep), pairs_.end());
}

void Contacts::forget(Body& body) {
  for (const PairKey& key : body.resting) {
    const auto pair = resting_.find(key);
    if (pair == resting_.end()) continue;
    note_change(*pair->second.first, *pair->second.second);
    resting_.erase(pair);
    with_smaller_.erase({key.second, key.first});
  }
  body.resting.clear();
}

void Contacts::drop_active(const ModelRecord& model) {
  const auto gone = [&](const Pair& pair) {
    if (pair.first->body->model != &model && pair.second->body->model != &model) return false;
    note_change(*pair.first, *pair.second);
    return true;
  };
  pairs_.erase(std::remove_if(pairs_.begin(), pairs_.end(), gone), pairs_.end());
}

std::vector<ContactPoint> Contacts::points_of(const Pair& pair) const {
  const auto begin = points_.begin() + static_cast<std::ptrdiff_t>(pair.begin);
  return {begin, begin + static_cast<std::ptrdiff_t>(pair.count)};
}

std::vector<ContactPair> Contacts::of(const Geom& geom) const {
  std::map<std::uint64_t, ContactPair> found;  // by the other's serial
  const auto add = [&](const Geom& first, const Geom& second, std::vector<ContactPoint> points) {
    found[&first == &geom ? second.serial : first.serial] =
        seen_from(geom, first, second, std::move(points));
  };
  for (const Pair& pair : pairs_) {
    if (pair.first == &geom || pair.second == &geom)
      add(*pair.first, *pair.second, points_of(pair));
  }
  const auto add_resting = [&](const Resting& r) { add(*r.first, *r.second, r.points); };
  const PairKey start{geom.serial, 0};
  for (auto at = resting_.lower_bound(start);
       at != resting_.end() && at->first.first == geom.serial; ++at) {
    add_resting(at->second);
  }
  for (auto at = with_smaller_.lower_bound(start);
       at != with_smaller_.end() && at->first == geom.serial; ++at) {
    add_resting(resting_.at({at->second, at->first}));
  }
  std::vector<ContactPair> all;
  all.reserve(found.size());
  for (auto& [serial, pair] : found) all.push_back(std::move(pair));
  return all;
}

std::vector<ContactPair> Contacts::list() const {
  std::vector<ContactPair> all;
  all.reserve(pairs_.size() + resting_.size());
  auto sleeping = resting_.begin();
  const auto take_sleeping = [&] {
    const Resting& r = (sleeping++)->second;
    all.push_back({r.first->name, r.second->name, r.points});
  };
  for (const Pair& pair : pairs_) {
    const PairKey key = key_of(pair);
    while (sleeping != resting_.end() && sleeping->first < key) take_sleeping();
    all.push_back({pair.first->name, pair.second->name, points_of(pair)});
  }
  while (sleeping != resting_.end()) take_sleeping();
  return all;
}

}  // namespace angen::physics

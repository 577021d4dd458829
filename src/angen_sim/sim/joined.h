#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "desc/world.h"

namespace angen::sim {

/// The links of `from`, and those that joints join to them: every joint that `follows` says, from
/// parent to child and, where `both_ways`, back. The cost grows with the model's size.
template <class F>
std::set<std::string> joined_to(std::set<std::string> from, const desc::Model& model,
                                bool both_ways, F&& follows) {
  std::multimap<std::string, std::string> next;
  for (const desc::Joint& joint : model.joints) {
    if (!follows(joint)) continue;
    next.emplace(joint.parent, joint.child);
    if (both_ways) next.emplace(joint.child, joint.parent);
  }
  std::vector<std::string> open(from.begin(), from.end());
  while (!open.empty()) {
    const std::string link = std::move(open.back());
    open.pop_back();
    const auto [begin, end] = next.equal_range(link);
    for (auto at = begin; at != end; ++at) {
      if (from.insert(at->second).second) open.push_back(at->second);
    }
  }
  return from;
}

inline bool is_fixed(const desc::Joint& joint) { return joint.type == desc::Joint::Type::kFixed; }

}  // namespace angen::sim

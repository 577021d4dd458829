#include "physics/islands.h"

#include <algorithm>

namespace angen::physics {

namespace {

// Their cost in dWorldStep: rows of joints have no bounds, unlike those of friction.
constexpr std::size_t kCostOfContact = 3;
constexpr std::size_t kCostOfJoint = 1;
constexpr std::size_t kMaxCost = 300;

// A body that has been stopped is like a static one.
bool joins(const Body& body) { return body.dynamic() && body.awake; }

}  // namespace

Islands::Islands(const std::vector<Body*>& awake, const std::vector<Contacts::Pair>& touching)
    : groups_(awake.size()) {
  for (std::uint32_t i = 0; i < awake.size(); ++i) awake[i]->island = i;
  for (const Body* body : awake) {
    for (const Joint* joint : body->joints) join(joint->first, joint->second);
  }
  for (const Contacts::Pair& pair : touching) join(pair.first->body, pair.second->body);
}

void Islands::join(const Body* a, const Body* b) {
  if (joins(*a) && joins(*b)) groups_.join(a->island, b->island);
}

bool mark_large_islands(const std::vector<Body*>& awake,
                        const std::vector<Contacts::Pair>& touching) {
  std::size_t sum = 0;
  for (const Body* body : awake) sum += kCostOfJoint * body->joints.size();
  for (const Contacts::Pair& pair : touching) sum += kCostOfContact * pair.count;
  for (Body* body : awake) body->iterated = false;
  if (sum <= kMaxCost) return false;

  const Islands islands(awake, touching);
  std::vector<std::size_t> costs(awake.size(), 0);
  for (const Body* body : awake) {
    for (const Joint* joint : body->joints) {
      if (joint->first == body) costs[islands.of(*body)] += kCostOfJoint;
    }
  }
  for (const Contacts::Pair& pair : touching) {
    const Body& body = joins(*pair.first->body) ? *pair.first->body : *pair.second->body;
    costs[islands.of(body)] += kCostOfContact * pair.count;
  }
  for (Body* body : awake) body->iterated = costs[islands.of(*body)] > kMaxCost;
  return *std::max_element(costs.begin(), costs.end()) > kMaxCost;
}

}  // namespace angen::physics

#include "plugin/touches.h"

#include <algorithm>
#include <utility>

#include "plugin/view.h"

namespace angen {

namespace {

bool has_turned(const std::vector<ContactPair>& pairs, const ContactPair& pair) {
  return std::any_of(pairs.begin(), pairs.end(), [&](const ContactPair& other) {
    return other.first == pair.second && other.second == pair.first;
  });
}

}  // namespace

void Touches::watch(std::vector<ContactRef> collisions, Nanoseconds window) {
  collisions_ = std::move(collisions);
  window_ = window;
}

std::vector<ContactPair> Touches::pairs(const View& view) {
  std::vector<ContactPair> all;
  lasting_ = true;
  for (const ContactRef collision : collisions_) {
    std::vector<ContactPair> found = view.contacts_within(collision, window_);
    if (found.size() != view.contacts(collision).size()) lasting_ = false;
    for (ContactPair& pair : found) {
      if (!has_turned(all, pair)) all.push_back(std::move(pair));
    }
  }
  return all;
}

}  // namespace angen

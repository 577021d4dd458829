#include "core/nearest.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace angen {

namespace {

constexpr std::size_t kLongest = 256;  // longest name that is compared whole

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

}  // namespace

std::size_t edits(const std::string& a, const std::string& b) {
  if (std::max(a.size(), b.size()) > kLongest) return std::max(a.size(), b.size());
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t k = 0; k < b.size(); ++k) {
      const std::size_t replaced = diagonal + (lower(a[i]) == lower(b[k]) ? 0 : 1);
      diagonal = row[k + 1];
      row[k + 1] = std::min({replaced, diagonal + 1, row[k] + 1});
    }
  }
  return row.back();
}

std::vector<std::string> nearest_names(const std::string& name, std::vector<std::string> known,
                                       std::size_t count) {
  const std::string given = name.substr(0, kLongest);
  std::vector<std::pair<std::size_t, std::string>> ranked;
  ranked.reserve(known.size());
  for (std::string& each : known) {
    ranked.emplace_back(edits(given, each.substr(0, kLongest)), std::move(each));
  }
  std::sort(ranked.begin(), ranked.end());
  if (ranked.size() > count) ranked.resize(count);
  std::vector<std::string> nearest;
  nearest.reserve(ranked.size());
  for (auto& [rank, each] : ranked) nearest.push_back(std::move(each));
  return nearest;
}

std::string did_you_mean(const std::string& name, const std::vector<std::string>& known) {
  const std::vector<std::string> nearest = nearest_names(name, known);
  if (nearest.empty()) return "there are none";
  std::string text = "did you mean " + nearest.front();
  for (std::size_t i = 1; i < nearest.size(); ++i) {
    text += (i + 1 == nearest.size() ? " or " : ", ") + nearest[i];
  }
  return text + "?";
}

}  // namespace angen

#include "core/alike.h"

#include <gtest/gtest.h>

namespace angen {
namespace {

std::vector<std::string> lines(const std::vector<int>& at, const std::string& file = "a.world") {
  std::vector<std::string> all;
  for (const int line : at) {
    all.push_back(file + ":" + std::to_string(line) + ": the part 'x" + std::to_string(line) +
                  "' is 3 m too long");
  }
  return all;
}

TEST(Alike, ThreeOfOneReasonStay) {
  const auto three = lines({2, 5, 9});
  EXPECT_EQ(merge_alike(three), three);
}

TEST(Alike, FourOfOneReasonAreOneWithTheirNumber) {
  auto all = lines({2, 5, 9, 7});
  all.insert(all.begin() + 1, "a.world:3: another");
  const std::vector<std::string> merged = {
      "a.world:2: the part 'x2' is 3 m too long (and 3 more like it, up to line 9: 'x5', 'x9', "
      "'x7')",
      "a.world:3: another"};
  EXPECT_EQ(merge_alike(all), merged);
}

TEST(Alike, AtMostTenOtherNamesAreListed) {
  const std::string merged = merge_alike(lines({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12})).at(0);
  EXPECT_NE(merged.find("'x10', 'x11', …)"), std::string::npos) << merged;
  EXPECT_EQ(merged.find("'x12'"), std::string::npos) << merged;
}

TEST(Alike, FilesAreKeptApart) {
  auto all = lines({1, 2});
  const auto other = lines({1, 2}, "b.world");
  all.insert(all.end(), other.begin(), other.end());
  EXPECT_EQ(merge_alike(all), all);
}

}  // namespace
}  // namespace angen

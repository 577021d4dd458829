#include "core/cells.h"

#include <gtest/gtest.h>

#include <set>

namespace angen {
namespace {

TEST(CellKey, DiffersBetweenCells) {
  std::set<std::uint64_t> keys;
  const int places[] = {-kCellLimit, -2, -1, 0, 1, 2, 1000, kCellLimit - 1};
  for (const int x : places) {
    for (const int y : places) {
      for (const int z : places) EXPECT_TRUE(keys.insert(cell_key(x, y, z)).second);
    }
  }
}

}  // namespace
}  // namespace angen

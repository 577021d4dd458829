#include "core/time.h"

#include <gtest/gtest.h>

namespace angen {
namespace {

TEST(Time, SecondsRoundToTheNearestNanosecond) {
  EXPECT_EQ(from_seconds(0.001), 1'000'000);
  EXPECT_EQ(from_seconds(0.1 + 0.2), 300'000'000);
  EXPECT_EQ(from_seconds(-1e-9), -1);
  EXPECT_DOUBLE_EQ(to_seconds(1'500'000'000), 1.5);
}

}  // namespace
}  // namespace angen

#include "sim/shared_array.h"

#include <gtest/gtest.h>

namespace angen::sim {
namespace {

SharedArray<int> counted(int n) {
  SharedArray<int> array;
  for (int i = 0; i < n; ++i) array.push_back(i);
  return array;
}

TEST(SharedArray, HoldsWhatWasPutIn) {
  const SharedArray<int> array = counted(200);
  ASSERT_EQ(array.size(), 200U);
  for (std::size_t i = 0; i < array.size(); ++i) EXPECT_EQ(array[i], static_cast<int>(i));
}

TEST(SharedArray, ACopyKeepsItsValuesWhenTheOriginalChanges) {
  SharedArray<int> array = counted(200);
  const SharedArray<int> copy = array;
  array.set(70, -1);
  EXPECT_EQ(array[70], -1);
  EXPECT_EQ(copy[70], 70);
}

TEST(SharedArray, ACopySharesWhatDidNotChange) {
  SharedArray<int> array = counted(200);
  const SharedArray<int> copy = array;
  array.set(70, -1);
  EXPECT_EQ(&array[0], &copy[0]);
  EXPECT_NE(&array[64], &copy[64]);
}

TEST(SharedArray, GrowingDoesNotTouchACopy) {
  SharedArray<int> array = counted(65);
  const SharedArray<int> copy = array;
  array.push_back(7);
  EXPECT_EQ(copy.size(), 65U);
  EXPECT_EQ(array[65], 7);
}

}  // namespace
}  // namespace angen::sim

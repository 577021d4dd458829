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
  const SharedArray<int> array = counted(5000);
  ASSERT_EQ(array.size(), 5000U);
  for (std::size_t i = 0; i < array.size(); ++i) EXPECT_EQ(array[i], static_cast<int>(i));
}

TEST(SharedArray, ACopyKeepsItsValuesWhenTheOriginalChanges) {
  SharedArray<int> array = counted(5000);
  const SharedArray<int> copy = array;
  for (const int i : {70, 4000}) {
    array.set(i, -1);
    EXPECT_EQ(array[i], -1);
    EXPECT_EQ(copy[i], i);
  }
}

TEST(SharedArray, ACopySharesWhatDidNotChange) {
  SharedArray<int> array = counted(200);
  const SharedArray<int> copy = array;
  array.set(70, -1);
  EXPECT_EQ(&array[0], &copy[0]);
  EXPECT_NE(&array[64], &copy[64]);
}

TEST(SharedArray, GrowingDoesNotTouchACopy) {
  for (const int size : {65, 128, 2048}) {
    SharedArray<int> array = counted(size);
    const SharedArray<int> copy = array;
    array.push_back(7);
    EXPECT_EQ(copy.size(), static_cast<std::size_t>(size));
    EXPECT_EQ(array[size], 7);
    EXPECT_EQ(copy[size - 1], size - 1);
  }
}

}  // namespace
}  // namespace angen::sim

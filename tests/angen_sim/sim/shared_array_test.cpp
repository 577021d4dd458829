#include "sim/shared_array.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

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

TEST(SharedArray, IsWalkedThrough) {
  const SharedArray<int> array = counted(5000);
  EXPECT_EQ(std::vector<int>(array.begin(), array.end()).back(), 4999);
  EXPECT_EQ(std::find(array.begin(), array.end(), 70) - array.begin(), 70);
  EXPECT_EQ(array.back(), 4999);
}

TEST(SharedArray, CanBeTruncated) {
  for (const int size : {0, 1, 64, 65, 2047, 2048, 2049, 5000}) {
    SharedArray<int> array = counted(5000);
    const SharedArray<int> copy = array;
    array.truncate(size);
    ASSERT_EQ(array.size(), static_cast<std::size_t>(size));
    for (int i = size; i < 5100; ++i) array.push_back(-i);
    for (int i = 0; i < 5100; ++i) EXPECT_EQ(array[i], i < size ? i : -i);
    for (int i = 0; i < 5000; ++i) EXPECT_EQ(copy[i], i);
  }
}

TEST(SharedArray, LetsGoOfWhatIsTruncated) {
  const auto value = std::make_shared<int>(1);
  SharedArray<std::shared_ptr<int>> array;
  for (int i = 0; i < 130; ++i) array.push_back(value);
  array.truncate(65);
  EXPECT_EQ(value.use_count(), 1 + 65);
}

}  // namespace
}  // namespace angen::sim

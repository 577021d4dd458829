#include "ros/convert.h"

#include <gtest/gtest.h>

namespace angen::node {
namespace {

TEST(Convert, StampsKeepTheirNanoseconds) {
  const ros::Time stamp = to_ros(12'345'678'901);
  EXPECT_EQ(stamp.sec, 12U);
  EXPECT_EQ(stamp.nsec, 345678901U);
}

}  // namespace
}  // namespace angen::node

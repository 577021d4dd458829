#include "light/allowance.h"

#include <gtest/gtest.h>

namespace angen::light {
namespace {

TEST(Allowance, IsFullAtFirstAndGrowsWithTimeUpToALimit) {
  Allowance rays(1000, 50);
  EXPECT_EQ(rays.left(), 50);
  rays.spend(60);  // an overdraft is paid for later
  EXPECT_EQ(rays.left(), -10);
  rays.pass_to(10'000);
  EXPECT_EQ(rays.left(), 0);
  rays.pass_to(12'500);
  EXPECT_EQ(rays.left(), 2);
  rays.pass_to(kSecond);
  EXPECT_EQ(rays.left(), 50);
}

TEST(Allowance, IsTheSameHoweverOftenItIsAsked) {
  Allowance often(1300, 1000), once(1300, 1000);
  often.spend(900);
  once.spend(900);
  for (Nanoseconds now = 0; now <= 100'003; now += 7) often.pass_to(now);
  often.pass_to(100'003);
  once.pass_to(100'003);
  EXPECT_EQ(often.left(), once.left());
}

TEST(Allowance, GivesNothingForTimeThatGoesBack) {
  Allowance rays(1000, 50);
  rays.pass_to(kSecond);
  rays.spend(50);
  rays.pass_to(0);
  EXPECT_EQ(rays.left(), 0);
  rays.pass_to(5000);
  EXPECT_EQ(rays.left(), 5);
}

}  // namespace
}  // namespace angen::light

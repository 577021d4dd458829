#include "core/limits.h"

#include <gtest/gtest.h>

#include <cmath>

namespace angen {
namespace {

TEST(Limit, SaysWhatWouldBeRight) {
  EXPECT_EQ(limit_problem(limits::kPosition, 5.0), "");
  EXPECT_EQ(limit_problem(limits::kPosition, -1e6), "");
  EXPECT_EQ(limit_problem(limits::kPosition, 1e19), "it must be at most 1e+06 m");
  EXPECT_EQ(limit_problem(limits::kPosition, -1e308), "it must be at least -1e+06 m");
  EXPECT_EQ(limit_problem(limits::kMass, NAN), "it must be finite");
  EXPECT_EQ(limit_problem(limits::kMass, INFINITY), "it must be finite");
  EXPECT_EQ(limit_problem(limits::kMass, 1e-320, true), "it must be at least 1e-09 kg");
  EXPECT_EQ(limit_problem(limits::kMass, 0.0), "");
}

TEST(Limit, OfAUnit) {
  EXPECT_EQ(limit_of_unit("m").most, limits::kPosition.most);
  EXPECT_EQ(limit_of_unit("rad/s").most, limits::kTurnRate.most);
  EXPECT_EQ(limit_of_unit("lm").most, limits::kOther.most);
  EXPECT_EQ(limit_of_unit("").most, limits::kOther.most);
}

TEST(Limit, OfAPose) {
  EXPECT_EQ(pose_problem({}), "");
  EXPECT_EQ(pose_problem({{0.0, 1e19, 0.0}, Quat::Identity()}),
            "the position is 1e+19 m; it must be at most 1e+06 m");
  EXPECT_NE(pose_problem({{0.0, NAN, 0.0}, Quat::Identity()}), "");
}

TEST(Limit, LetsRealRobotsPass) {
  EXPECT_EQ(limit_problem(limits::kMoment, 1e-9, true), "");
  EXPECT_EQ(limit_problem(limits::kNoLimit, 1e16), "");
  EXPECT_EQ(limit_problem(limits::kOther, 1e12), "");
}

}  // namespace
}  // namespace angen

#include "sim/sensor_activity.h"

#include <gtest/gtest.h>

namespace angen::sim {
namespace {

using State = SensorActivity::State;

TEST(SensorActivity, StartsActive) {
  const SensorActivity activity;
  EXPECT_EQ(activity.state(), State::kActive);
  EXPECT_FALSE(activity.skips());
  EXPECT_FALSE(activity.published());
}

TEST(SensorActivity, ASteadyOneRepeatsOnceItHasPublished) {
  SensorActivity activity;
  activity.sampled(true, false, false);
  EXPECT_EQ(activity.state(), State::kSteady);
  EXPECT_FALSE(activity.skips());
  activity.publish();
  EXPECT_EQ(activity.state(), State::kRepeating);
  EXPECT_TRUE(activity.skips());
}

TEST(SensorActivity, ARepeatingOneGoesOnWithTheSameValuesAndPublishesOthers) {
  SensorActivity activity;
  activity.sampled(true, false, false);
  activity.publish();
  activity.sampled(true, false, true);
  EXPECT_EQ(activity.state(), State::kRepeating);
  activity.sampled(true, false, false);
  EXPECT_EQ(activity.state(), State::kSteady);
  EXPECT_FALSE(activity.published());
}

TEST(SensorActivity, AnActiveOneThatPublishedRepeatsWhenItIsSteadyWithTheSameValues) {
  SensorActivity activity;
  activity.sampled(false, false, false);
  activity.publish();
  EXPECT_EQ(activity.state(), State::kActive);
  activity.sampled(true, false, true);
  EXPECT_EQ(activity.state(), State::kRepeating);
}

TEST(SensorActivity, AVaryingOneIsLazyUntilItResumes) {
  SensorActivity activity;
  activity.sampled(true, true, true);
  EXPECT_EQ(activity.state(), State::kVarying);
  EXPECT_FALSE(activity.skips());
  activity.become_lazy();
  EXPECT_TRUE(activity.lazy());
  EXPECT_TRUE(activity.skips());
  activity.resume();
  EXPECT_EQ(activity.state(), State::kVarying);
}

TEST(SensorActivity, AnythingBecomesActiveAgain) {
  SensorActivity activity;
  activity.sampled(true, false, false);
  activity.publish();
  activity.sampled(false, false, true);
  EXPECT_EQ(activity.state(), State::kActive);
  EXPECT_FALSE(activity.published());
}

TEST(SensorActivity, IsSettledAfterMoreUnchangedSamplesThanItsReadingsDependOn) {
  SensorActivity activity;
  EXPECT_FALSE(activity.settled(0));
  activity.note_unchanged();
  EXPECT_TRUE(activity.settled(0));
  EXPECT_FALSE(activity.settled(1));
  activity.note_unchanged();
  EXPECT_TRUE(activity.settled(1));
  activity.note_changed();
  EXPECT_FALSE(activity.settled(0));
}

}  // namespace
}  // namespace angen::sim

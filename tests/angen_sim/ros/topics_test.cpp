#include "ros/topics.h"

#include <gtest/gtest.h>

#include "angen_sim/ros/messages.h"
#include "core/diagnostics.h"

namespace angen::node {
namespace {

TEST(Topics, KindsOfWhichThereMayBeManyShareTheirs) {
  for (const char* kind : {"pir", "switch", "luminosity", "contact", "smoke"}) {
    EXPECT_TRUE(goes_with_its_kind(Topics::kKind, format_of(kind), nullptr)) << kind;
    EXPECT_FALSE(goes_with_its_kind(Topics::kSensor, format_of(kind), nullptr)) << kind;
  }
  EXPECT_EQ(format_of("pir").array_type, "angen_msgs/PirArray");
  EXPECT_EQ(format_of("smoke").array_type, "angen_msgs/ReadingArray");
  EXPECT_EQ(kind_topic("smoke"), "/angen/smoke");
}

TEST(Topics, PicturesScansAndWhatARobotCarriesKeepTheirOwn) {
  const Robot robot;
  EXPECT_FALSE(goes_with_its_kind(Topics::kKind, format_of("contact"), &robot));
  EXPECT_FALSE(goes_with_its_kind(Topics::kKind, format_of("lidar"), nullptr));
  for (const Format& format : formats_of("depth")) {
    EXPECT_FALSE(goes_with_its_kind(Topics::kKind, format, nullptr)) << format.type;
  }
}

TEST(Topics, AreNamedBySensorOrKind) {
  EXPECT_EQ(topics_named("sensor"), Topics::kSensor);
  EXPECT_EQ(topics_named("kind"), Topics::kKind);
  EXPECT_THROW(topics_named("Kind"), Error);
}

}  // namespace
}  // namespace angen::node

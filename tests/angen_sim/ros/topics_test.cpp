#include "ros/topics.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "angen_sim/ros/messages.h"
#include "core/diagnostics.h"

namespace angen::node {
namespace {

using Names = std::vector<std::string>;

TEST(Topics, KindsOfWhichThereMayBeManyShareTheirs) {
  for (const char* kind : {"pir", "switch", "luminosity", "contact", "smoke"}) {
    EXPECT_TRUE(is_on_topic_of_kind(Topics::kKind, format_of(kind), nullptr)) << kind;
    EXPECT_FALSE(is_on_topic_of_kind(Topics::kSensor, format_of(kind), nullptr)) << kind;
  }
  EXPECT_EQ(format_of("pir").array_type, "angen_msgs/PirArray");
  EXPECT_EQ(format_of("smoke").array_type, "angen_msgs/ReadingArray");
  EXPECT_EQ(kind_topic("smoke"), "/angen/smoke");
}

TEST(Topics, PicturesScansAndWhatARobotCarriesKeepTheirOwn) {
  const Robot robot;
  EXPECT_FALSE(is_on_topic_of_kind(Topics::kKind, format_of("contact"), &robot));
  EXPECT_FALSE(is_on_topic_of_kind(Topics::kKind, format_of("lidar"), nullptr));
  for (const Format& format : formats_of("depth")) {
    EXPECT_FALSE(is_on_topic_of_kind(Topics::kKind, format, nullptr)) << format.type;
  }
}

TEST(Topics, AreNamedBySensorOrKind) {
  EXPECT_EQ(topics_named("sensor"), Topics::kSensor);
  EXPECT_EQ(topics_named("kind"), Topics::kKind);
  EXPECT_THROW(topics_named("Kind"), Error);
}

sim::SensorEntry sensor(const std::string& kind,
                        const std::vector<std::pair<std::string, std::string>>& parameters = {}) {
  sim::SensorEntry entry;
  entry.kind = kind;
  entry.name = "it";
  auto described = std::make_shared<desc::Sensor>();
  for (const auto& [key, value] : parameters) {
    Element child;
    child.name = key;
    child.text = value;
    described->plugin_element.children.push_back(child);
    if (key == "topicName") entry.topic = value;
  }
  entry.desc = described;
  return entry;
}

TEST(Topics, ASensorByItselfPublishesUnderItsKindAndName) {
  EXPECT_EQ(sensor_topics(sensor("lidar"), format_of("lidar"), nullptr), Names{"/angen/lidar/it"});
  const std::vector<Format>& formats = formats_of("depth");
  ASSERT_EQ(formats.size(), 5U);
  EXPECT_EQ(sensor_topics(sensor("depth"), formats[2], nullptr), Names{"/angen/depth/it/points"});
  EXPECT_TRUE(sensor_topics(sensor("depth"), formats[3], nullptr).empty()) << "it has no colors";
}

TEST(Topics, ARobotsTopicsStandBelowItsNameAndTheFirstOnesAlsoAlone) {
  Robot robot;
  robot.name = "r2";
  const sim::SensorEntry scan = sensor("lidar", {{"topicName", "scan"}});
  EXPECT_EQ(sensor_topics(scan, format_of("lidar"), &robot), Names{"/r2/scan"});
  robot.first = true;
  EXPECT_EQ(sensor_topics(scan, format_of("lidar"), &robot), (Names{"/r2/scan", "/scan"}));
}

TEST(Topics, AKinectHasGazebosTopicsWhereItHasColors) {
  const sim::SensorEntry kinect = sensor(
      "depth_camera",
      {{"cameraName", "cam"}, {"imageTopicName", "rgb/image_raw"}, {"robotNamespace", "/bot"}});
  Names topics;
  for (const Format& format : formats_of("depth_camera")) {
    topics.push_back(sensor_topics(kinect, format, nullptr).at(0));
  }
  EXPECT_EQ(topics,
            (Names{"/bot/cam/depth/image_raw", "/bot/cam/depth/camera_info", "/bot/cam/points",
                   "/bot/cam/rgb/image_raw", "/bot/cam/ir/camera_info"}));
}

TEST(Topics, CamerasTakeGazebosTopicNames) {
  Robot robot;
  robot.name = "r2";
  const sim::SensorEntry camera =
      sensor("camera", {{"cameraName", "camera"}, {"imageTopicName", "rgb/image_raw"}});
  const std::vector<Format>& formats = formats_of("camera");
  EXPECT_EQ(sensor_topics(camera, formats[0], &robot), Names{"/r2/camera/rgb/image_raw"});
  EXPECT_EQ(sensor_topics(camera, formats[1], &robot), Names{"/r2/camera/camera_info"});
}

}  // namespace
}  // namespace angen::node

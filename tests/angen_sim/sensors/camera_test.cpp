#include <gtest/gtest.h>

#include <cmath>

#include "bench.h"

namespace angen {
namespace {

using test::Bench;
using test::element;
using test::plugin_element;

const char* const kCamera = "libgazebo_ros_camera.so";
const char* const kDepth = "libgazebo_ros_openni_kinect.so";

Element lens(const std::string& width, const std::string& near = "0.1") {
  return test::sensor_element(
      {element("camera", "",
               {element("horizontal_fov", "1.2"),
                element("image", "", {element("width", width), element("height", "2")}),
                element("clip", "", {element("near", near), element("far", "9")})})});
}

TEST(Camera, LooksThroughTheLensOfItsSdfFromItsPlace) {
  Bench bench(kCamera, plugin_element({}), lens("3"));
  bench.world.at = {{1.0, 2.0, 3.0}, from_rpy(0.1, 0.2, 0.3)};
  const std::vector<std::uint8_t> seen{1, 2,  3,  4,  5,  6,  7,  8,  9,
                                       9, 10, 11, 12, 13, 14, 15, 16, 17};
  bench.world.colors_at = [&](const render::PinholeCamera& lens, const Pose& pose) {
    EXPECT_EQ(lens.width, 3);
    EXPECT_EQ(lens.height, 2);
    EXPECT_EQ(lens.near, 0.1);
    EXPECT_EQ(lens.far, 9.0);
    EXPECT_EQ(pose, bench.world.at);
    return seen;
  };
  const Reading reading = bench.sample();
  const auto image = reading.get<ByteImage>("image");
  ASSERT_NE(image.values, nullptr);
  EXPECT_EQ(*image.values, seen);
  EXPECT_EQ(image.width, 3U);
  EXPECT_EQ(image.height, 2U);
  EXPECT_EQ(image.channels, 3U);
  EXPECT_NEAR(reading.get<double>("focal"), 1.5 / std::tan(0.6), 1e-12);
  EXPECT_EQ(reading.get<double>("center_x"), 1.0);
  EXPECT_EQ(reading.get<double>("center_y"), 0.5);
}

TEST(Camera, DepthIsAGridOfOneChannel) {
  Bench bench(kDepth, plugin_element({}), lens("2"));
  bench.world.depths_at = [](const render::PinholeCamera&, const Pose&) {
    return std::vector<float>{1.0F, 2.0F, 3.0F, 4.0F};
  };
  const auto depth = bench.sample().get<FloatImage>("depth");
  ASSERT_NE(depth.values, nullptr);
  EXPECT_EQ(depth.values->at(3), 4.0F);
  EXPECT_EQ(depth.channels, 1U);
}

TEST(Camera, LooksOnDemandThirtyTimesASecond) {
  for (const char* library : {kCamera, kDepth}) {
    const Bench bench(library);
    EXPECT_TRUE(bench.kind().is_on_demand);
    EXPECT_EQ(bench.kind().rate(), 30.0);
  }
}

TEST(Camera, TakesTheTopicsOfGazebosPlugins) {
  EXPECT_EQ(test::complaint_of(kCamera, plugin_element({{"cameraName", "camera"},
                                                        {"imageTopicName", "rgb/image_raw"},
                                                        {"cameraInfoTopicName", "rgb/info"}})),
            "");
  EXPECT_EQ(test::complaint_of(kDepth, plugin_element({{"cameraName", "camera"},
                                                       {"depthImageTopicName", "depth/image_raw"},
                                                       {"pointCloudTopicName", "depth/points"}})),
            "");
}

TEST(Camera, RejectsALensThatSeesNothing) {
  EXPECT_NE(test::complaint_of(kCamera, plugin_element({}), lens("0")).find("<camera/image/width>"),
            std::string::npos);
  EXPECT_NE(test::complaint_of(kDepth, plugin_element({}), lens("4", "9.5")).find("near is above"),
            std::string::npos);
}

TEST(Camera, ImagesOfEqualPixelsAreEqualReadings) {
  Bench bench(kDepth, plugin_element({}), lens("2"));
  float last = 4.0F;
  bench.world.depths_at = [&](const render::PinholeCamera&, const Pose&) {
    return std::vector<float>{1.0F, 2.0F, 3.0F, last};
  };
  const Reading first = bench.sample();
  EXPECT_TRUE(first.same_values(bench.sample()));
  last = 5.0F;
  EXPECT_FALSE(first.same_values(bench.sample()));
}

TEST(Camera, AGrayOneHasTheLumaOfItsColors) {
  Element sensor = lens("2");
  sensor.children[0].children[1].children.push_back(element("format", "L8"));
  Bench bench(kCamera, plugin_element({}), sensor);
  bench.world.colors_at = [](const render::PinholeCamera&, const Pose&) {
    return std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};
  };
  const auto image = bench.sample().get<ByteImage>("image");
  EXPECT_EQ(image.channels, 1U);
  ASSERT_NE(image.values, nullptr);
  EXPECT_EQ(*image.values, (std::vector<std::uint8_t>{76, 150, 29, 255}));
}

TEST(Camera, ItsLensIsThatOfThePlugin) {
  Bench bench(kCamera,
              plugin_element({{"distortionK1", "-0.2"},
                              {"distortionT2", "0.01"},
                              {"hackBaseline", "0.07"},
                              {"CxPrime", "320.5"}}),
              lens("2"));
  bench.world.colors_at = [](const render::PinholeCamera& seen, const Pose&) {
    EXPECT_EQ(seen.distortion.k1, -0.2);
    return std::vector<std::uint8_t>(12);
  };
  const Reading reading = bench.sample();
  EXPECT_EQ(reading.get<std::vector<double>>("distortion"),
            (std::vector<double>{-0.2, 0.0, 0.0, 0.01, 0.0}));
  EXPECT_EQ(reading.get<double>("baseline"), 0.07);
}

TEST(Camera, ItsLensIsItsOwnIfItHasOne) {
  Element own = element("distortion", "");
  own.children.push_back(element("k1", "-0.3"));
  Element sensor = lens("2");
  sensor.children[0].children.push_back(own);
  Bench bench(kCamera, plugin_element({{"distortionK1", "-0.2"}}), sensor);
  bench.world.colors_at = [](const render::PinholeCamera&, const Pose&) {
    return std::vector<std::uint8_t>(12);
  };
  EXPECT_EQ(bench.sample().get<std::vector<double>>("distortion")[0], -0.3);
}

TEST(Camera, WhatALensBendsIsBentBack) {
  render::Distortion lens;
  lens.k1 = -0.25;
  lens.k2 = 0.05;
  lens.p1 = 0.002;
  lens.p2 = -0.001;
  for (const auto& [x, y] : {std::pair(0.0, 0.0), {0.3, -0.2}, {-0.5, 0.4}}) {
    double shown_x = 0.0, shown_y = 0.0, back_x = 0.0, back_y = 0.0;
    lens.distort(x, y, shown_x, shown_y);
    lens.undistort(shown_x, shown_y, back_x, back_y);
    EXPECT_NEAR(back_x, x, 1e-6);
    EXPECT_NEAR(back_y, y, 1e-6);
  }
}

// With an imageTopicName it is Gazebo's, with its limits and a color image.
TEST(Camera, ADepthCameraOfGazebosSeesFromItsCutoffOn) {
  const auto depths_of = [](const std::string& library,
                            std::vector<std::pair<std::string, std::string>> parameters) {
    Bench bench(library, plugin_element(parameters), lens("2"));
    bench.world.depths_at = [](const render::PinholeCamera&, const Pose&) {
      return std::vector<float>{0.3F, 1.0F, 4.9F, 6.0F};
    };
    bench.world.colors_at = [](const render::PinholeCamera&, const Pose&) {
      return std::vector<std::uint8_t>(12, 7);
    };
    const Reading reading = bench.sample();
    EXPECT_EQ(reading.find("image") != nullptr, parameters.size() > 1);
    std::string seen;
    const auto depth = reading.get<FloatImage>("depth");
    for (const float value : *depth.values) seen += std::isnan(value) ? "-" : "x";
    return seen;
  };
  const std::pair<std::string, std::string> camera{"cameraName", "c"};
  const std::pair<std::string, std::string> color{"imageTopicName", "rgb/image_raw"};
  const char* const kOther = "libgazebo_ros_depth_camera.so";
  EXPECT_EQ(depths_of(kDepth, {camera}), "xxxx");
  EXPECT_EQ(depths_of(kDepth, {camera, color}), "-xx-");
  EXPECT_EQ(depths_of(kOther, {camera, color}), "-xxx");
  EXPECT_EQ(
      depths_of(kDepth, {camera, color, {"pointCloudCutoff", "0.2"}, {"pointCloudCutoffMax", "2"}}),
      "xx--");
}

}  // namespace
}  // namespace angen

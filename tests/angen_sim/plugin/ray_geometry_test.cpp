#include "plugin/ray_geometry.h"

#include <gtest/gtest.h>

#include "angen_sim/fakes.h"

namespace angen {
namespace {

Eigen::Vector4f color_of(const std::vector<std::pair<std::string, std::string>>& parameters) {
  Params params(test::plugin_element(parameters));
  return read_ray_color(params, Kind("beam", "").ray_color("0 0 1 0.5"));
}

TEST(RayColor, IsItsKindsUnlessItIsGiven) {
  EXPECT_EQ(color_of({}), Eigen::Vector4f(0.0F, 0.0F, 1.0F, 0.5F));
  EXPECT_EQ(color_of({{"color", "1 0.25 0"}}), Eigen::Vector4f(1.0F, 0.25F, 0.0F, 1.0F));
  EXPECT_EQ(color_of({{"color", "1 0.25 0 0.75"}}), Eigen::Vector4f(1.0F, 0.25F, 0.0F, 0.75F));
}

TEST(RayColor, WhatIsNoColorIsAnError) {
  for (const char* text : {"red", "1 0", "1 0 0 1 1", "1 0 2", "-1 0 0", ""}) {
    EXPECT_THROW(color_of({{"color", text}}), Error) << text;
  }
}

}  // namespace
}  // namespace angen

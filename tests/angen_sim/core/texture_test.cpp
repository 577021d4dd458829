#include "core/texture.h"

#include <gtest/gtest.h>

namespace angen {
namespace {

// Red and green above blue and white.
Texture four() { return {2, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}}; }

TEST(Texture, BytesAreSrgb) {
  EXPECT_EQ(linear(0), 0.0F);
  EXPECT_EQ(linear(255), 1.0F);
  EXPECT_NEAR(linear(188), 0.5F, 0.005F);
}

TEST(Texture, UGoesRightAndVUp) {
  const Texture texture = four();
  EXPECT_TRUE(texture.at(0.25F, 0.75F).isApprox(Eigen::Vector3f(1, 0, 0)));
  EXPECT_TRUE(texture.at(0.75F, 0.75F).isApprox(Eigen::Vector3f(0, 1, 0)));
  EXPECT_TRUE(texture.at(0.25F, 0.25F).isApprox(Eigen::Vector3f(0, 0, 1)));
  EXPECT_TRUE(texture.at(0.75F, 0.25F).isApprox(Eigen::Vector3f(1, 1, 1)));
}

TEST(Texture, IsInterpolatedAndRepeats) {
  const Texture texture = four();
  EXPECT_TRUE(texture.at(0.5F, 0.75F).isApprox(Eigen::Vector3f(0.5F, 0.5F, 0.0F)));
  EXPECT_TRUE(texture.at(0.0F, 0.75F).isApprox(texture.at(0.5F, 0.75F)));
  EXPECT_TRUE(texture.at(3.25F, -1.25F).isApprox(texture.at(0.25F, 0.75F)));
  EXPECT_TRUE(texture.at(0.0F, 0.0F / 0.0F).allFinite());
}

TEST(Texture, ItsMeanIsOfTheLight) {
  EXPECT_TRUE(four().mean().isApprox(Eigen::Vector3f(0.5F, 0.5F, 0.5F)));
  const Texture stripes{1, 2, {0, 0, 0, 255, 255, 255}};
  EXPECT_NEAR(stripes.mean().x(), 0.5F, 1e-6F);
}

}  // namespace
}  // namespace angen

#include "light/photometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "rooms.h"

namespace angen::light::testing {
namespace {

/// 1000 cd ahead, falling off with the cosine, in steps of 1 degree; the same in all planes.
Photometry lambertian() {
  Photometry out;
  for (int degree = 0; degree <= 90; ++degree) {
    out.vertical.push_back(degree * M_PI / 180);
    out.candela.push_back(1000.0 * std::cos(out.vertical.back()));
  }
  out.horizontal = {0.0};
  return out;
}

TEST(Photometry, FluxIsTheIntegralOfTheIntensities) {
  EXPECT_NEAR(flux(lambertian()), 1000.0 * M_PI, 0.1);
  const Photometry even{{0.0, M_PI}, {0.0}, {100.0, 100.0}};
  EXPECT_NEAR(flux(even), 400.0 * M_PI, 1e-9);
  // Half of the planes are dark: as much as the mean of both.
  const Photometry half{{0.0, M_PI}, {0.0, M_PI / 2, M_PI}, {100.0, 100.0, 50.0, 50.0, 0.0, 0.0}};
  EXPECT_NEAR(flux(half), 200.0 * M_PI, 1e-9);
}

TEST(Photometry, IntensityIsStraightBetweenTheAnglesGiven) {
  const Photometry quarter{{0.0, 1.0}, {0.0, M_PI / 2}, {8.0, 4.0, 8.0, 0.0}};
  EXPECT_DOUBLE_EQ(intensity(quarter, 0.5, 0.0), 6.0);
  EXPECT_DOUBLE_EQ(intensity(quarter, 1.0, M_PI / 4), 2.0);
  EXPECT_EQ(intensity(quarter, 1.1, 0.0), 0.0);
  for (const double about : {0.3, M_PI - 0.3, M_PI + 0.3, -0.3}) {  // planes of symmetry
    EXPECT_NEAR(intensity(quarter, 1.0, about), intensity(quarter, 1.0, 0.3), 1e-12);
  }
}

TEST(Photometry, ALampSpreadsItsFluxAsItsLuminaireDoes) {
  Lamp lamp = point_lamp(Vec3(0, 0, 2), 500.0 * M_PI);  // half of the file's
  lamp.photometry = std::make_shared<const Photometry>(lambertian());
  lamp.photometric_flux = flux(*lamp.photometry);
  rays::Scene scene;
  scene.commit();
  Lighting lighting(scene);
  lighting.add(lamp, 1.0);
  EXPECT_NEAR(lux(lighting, facing(Vec3(0, 0, 0), Vec3::UnitZ())), 500.0 / 4, 0.02);
  const Vec3 aside(2, 0, 0);  // 45 degrees: cos^4
  EXPECT_NEAR(lux(lighting, facing(aside, Vec3::UnitZ())), 500.0 / 4 / 4, 0.02);
  EXPECT_EQ(lux(lighting, facing(Vec3(0, 0, 4), -Vec3::UnitZ())), 0.0);
}

TEST(Photometry, PlanesAreCountedCounterclockwiseAsSeenFromAbove) {
  Photometry planes{{0.0, M_PI / 2}, {0.0, M_PI / 2, M_PI, 1.5 * M_PI, 2.0 * M_PI}, {}};
  for (const double candela : {200.0, 100.0, 50.0, 25.0, 200.0}) {
    planes.candela.insert(planes.candela.end(), {candela, candela});
  }
  Lamp lamp = point_lamp(Vec3(0, 0, 2), flux(planes));
  lamp.photometry = std::make_shared<const Photometry>(planes);
  lamp.photometric_flux = flux(planes);
  rays::Scene scene;
  scene.commit();
  Lighting lighting(scene);
  lighting.add(lamp, 1.0);
  const double falloff = std::pow(std::cos(M_PI / 4), 3) / 4;  // on the floor, 45 degrees aside
  const auto candela = [&](double x, double y) {
    return lux(lighting, facing(Vec3(x, y, 0), Vec3::UnitZ())) / falloff;
  };
  EXPECT_NEAR(candela(2, 0), 200.0, 0.1);
  EXPECT_NEAR(candela(0, 2), 100.0, 0.1);
  EXPECT_NEAR(candela(-2, 0), 50.0, 0.1);
  EXPECT_NEAR(candela(0, -2), 25.0, 0.1);
}

}  // namespace
}  // namespace angen::light::testing

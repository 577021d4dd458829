// Illuminances with closed forms in photometry.
#include <gtest/gtest.h>

#include <cmath>

#include "rooms.h"

namespace angen::light::testing {
namespace {

constexpr double kThousandCandela = 4 * M_PI * 1000;  // lm, isotropic

/// A lamp 2 m above the origin in empty space.
struct Open {
  explicit Open(const Lamp& lamp) {
    scene.commit();
    lighting.add(lamp, 1.0);
  }
  rays::Scene scene;
  Lighting lighting{scene};
};

TEST(Reference, ThousandCandelaAtTwoMetres) {
  const Open open(point_lamp(Vec3(0, 0, 2), kThousandCandela));
  EXPECT_NEAR(lux(open.lighting, facing(Vec3(0, 0, 0), Vec3::UnitZ())), 250.0, 0.05);
  EXPECT_NEAR(lux(open.lighting, facing(Vec3(1, 0, 0), Vec3::UnitZ())), 178.9, 0.05);
  EXPECT_NEAR(lux(open.lighting, facing(Vec3(0, 2, 0), Vec3::UnitZ())), 88.39, 0.01);
}

TEST(Reference, InverseSquare) {
  const Open open(point_lamp(Vec3(0, 0, 2), kThousandCandela));
  for (const double distance : {0.1, 0.5, 1.0, 3.0, 10.0, 100.0}) {
    const Pose below = facing(Vec3(0, 0, 2 - distance), Vec3::UnitZ());
    EXPECT_NEAR(lux(open.lighting, below) * distance * distance, 1000.0, 1e-6) << distance;
  }
}

TEST(Reference, WithinItsRadiusALampIsNoBrighterThanItsSurface) {
  const Open open(point_lamp(Vec3(0, 0, 2), kThousandCandela));
  EXPECT_NEAR(lux(open.lighting, facing(Vec3(0, 0, 1.99), Vec3::UnitZ())), 1000 / 0.0025, 1e-6);
}

TEST(Reference, CosineOfTheTilt) {
  Lamp lamp = point_lamp(Vec3(0, 0, 2), kThousandCandela);
  lamp.radius = 0.0;  // a plane at 90 degrees would still see half of a globe
  const Open open(lamp);
  for (int degrees = 0; degrees < 180; degrees += 15) {
    const double tilt = degrees * M_PI / 180;
    const Vec3 normal(std::sin(tilt), 0, std::cos(tilt));
    const double expected = 250.0 * std::max(0.0, std::cos(tilt));
    EXPECT_NEAR(lux(open.lighting, facing(Vec3(0, 0, 0), normal)), expected, 1e-9) << degrees;
  }
}

TEST(Reference, SpotSpreadsItsFluxOverItsCone) {
  Lamp spot = point_lamp(Vec3(0, 0, 2), 800.0);
  spot.type = Lamp::Type::kSpot;
  spot.inner_angle = spot.outer_angle = M_PI / 2;  // from side to side
  const Open open(spot);
  const double candela = 800.0 / (2 * M_PI * (1 - std::cos(M_PI / 4)));
  EXPECT_NEAR(lux(open.lighting, facing(Vec3(0, 0, 0), Vec3::UnitZ())), candela / 4, 1e-9);
  EXPECT_GT(lux(open.lighting, facing(Vec3(1.99, 0, 0), Vec3::UnitZ())), 0.0);
  EXPECT_EQ(lux(open.lighting, facing(Vec3(2.01, 0, 0), Vec3::UnitZ())), 0.0);
  EXPECT_EQ(lux(open.lighting, facing(Vec3(0, 0, 4), -Vec3::UnitZ())), 0.0);
}

TEST(Reference, SpotFluxIsTheIntegralOfItsSoftCone) {
  Lamp spot = point_lamp(Vec3(0, 0, 2), 800.0);
  spot.type = Lamp::Type::kSpot;
  spot.inner_angle = 0.5;
  spot.outer_angle = 1.5;
  const Open open(spot);
  double flux = 0.0;
  constexpr int kRings = 4000;
  const double outer = 1.05 * std::tan(0.75) * 2;  // m on the floor, beyond the cone
  for (int i = 0; i < kRings; ++i) {
    const double r = outer * (i + 0.5) / kRings;
    flux +=
        lux(open.lighting, facing(Vec3(r, 0, 0), Vec3::UnitZ())) * 2 * M_PI * r * outer / kRings;
  }
  EXPECT_NEAR(flux, 800.0, 0.5);
}

TEST(Reference, SunIsTheSameEverywhere) {
  Lamp sun = point_lamp(Vec3(0, 0, 2), 1000.0);
  sun.type = Lamp::Type::kDirectional;
  sun.direction = Vec3(0, 3, -4) / 5;
  const Open open(sun);
  EXPECT_NEAR(lux(open.lighting, facing(Vec3(0, 0, 0), Vec3::UnitZ())), 800.0, 1e-9);
  EXPECT_NEAR(lux(open.lighting, facing(Vec3(70, -80, 9), Vec3::UnitZ())), 800.0, 1e-9);
  EXPECT_EQ(lux(open.lighting, facing(Vec3(0, 0, 0), -Vec3::UnitZ())), 0.0);
}

/// A flat lamp of 1000 cd/m^2 at the height given that shines down on the origin.
Lamp flat_lamp(Lamp::Type type, double height, double area) {
  Lamp lamp = point_lamp(Vec3(0, 0, height), M_PI * 1000 * area);
  lamp.type = type;
  return lamp;
}

double under_square(double side, double height, const Vec3& point) {
  Lamp square = flat_lamp(Lamp::Type::kRectangle, height, side * side);
  square.width = square.height = side;
  const Open open(square);
  return lux(open.lighting, facing(point, Vec3::UnitZ()));
}

TEST(Reference, UnderALambertianDisc) {
  Lamp disc = flat_lamp(Lamp::Type::kDisc, 1.0, M_PI * 0.25);
  disc.radius = 0.5;
  const Open open(disc);
  EXPECT_NEAR(lux(open.lighting, facing(Vec3(0, 0, 0), Vec3::UnitZ())), 628.3, 0.3);
  EXPECT_EQ(lux(open.lighting, facing(Vec3(0, 0, 2), -Vec3::UnitZ())), 0.0);
}

TEST(Reference, UnderLambertianSquares) {
  EXPECT_NEAR(under_square(2.0, 1.0, Vec3(0, 0, 0)), 1740.8, 0.1);
  EXPECT_NEAR(under_square(1.0, 2.0, Vec3(0, 0, 0)), 230.8, 0.1);
  // Under a corner: a quarter of that under the middle of a square twice as wide.
  EXPECT_NEAR(under_square(1.0, 1.0, Vec3(0.5, 0.5, 0)), 1740.8 / 4, 0.05);
}

TEST(Reference, ASquareBehindTheSensorsPlaneIsClippedByIt) {
  Lamp square = flat_lamp(Lamp::Type::kRectangle, 1.0, 4.0);
  square.width = square.height = 2.0;
  const Open open(square);
  const auto facing_lux = [&](const Vec3& normal) {
    return lux(open.lighting, facing(Vec3(0, 0, 0), normal));
  };
  // Half of it is in front of an upright plane; the vectors' sum is that of the flux vector.
  EXPECT_GT(facing_lux(Vec3::UnitX()), 0.0);
  EXPECT_NEAR(facing_lux(Vec3::UnitX()), facing_lux(-Vec3::UnitX()), 1e-9);
  EXPECT_EQ(facing_lux(-Vec3::UnitZ()), 0.0);
}

/// Sum over the parts of a globe's surface, each a Lambertian disc, of their illuminance on a
/// plane.
double summed_globe(double radius, const Vec3& center, const Vec3& normal, double flux) {
  const double luminance = flux / (4 * M_PI * M_PI * radius * radius);
  constexpr int kRings = 1000;
  double sum = 0.0;
  for (int i = 0; i < kRings; ++i) {
    for (int j = 0; j < 2 * kRings; ++j) {
      const double z = 1 - 2 * (i + 0.5) / kRings, angle = M_PI * (j + 0.5) / kRings;
      const double around = std::sqrt(1 - z * z);
      const Vec3 out(around * std::cos(angle), around * std::sin(angle), z);
      const Vec3 way = center + radius * out;
      const double leaving = std::max(0.0, -out.dot(way)),
                   arriving = std::max(0.0, normal.dot(way));
      sum += leaving * arriving / std::pow(way.squaredNorm(), 2);
    }
  }
  return luminance * sum * 4 * M_PI * radius * radius / (2.0 * kRings * kRings);
}

TEST(Reference, AnOpalGlobeThatThePlaneCuts) {
  Lamp globe = point_lamp(Vec3(0, 0, 0.5), 800.0);
  globe.radius = 0.2;
  const Open open(globe);
  for (const double tilt : {0.0, 0.8, 1.3, 1.5, 1.7, 1.9}) {
    const Vec3 normal(std::sin(tilt), 0, std::cos(tilt));
    const double expected = summed_globe(0.2, Vec3(0, 0, 0.5), normal, 800.0);
    EXPECT_NEAR(lux(open.lighting, facing(Vec3(0, 0, 0), normal)), expected,
                0.002 * expected + 0.05)
        << tilt;
  }
  EXPECT_EQ(lux(open.lighting, facing(Vec3(0, 0, 0), Vec3(std::sin(2.1), 0, std::cos(2.1)))), 0.0);
}

TEST(Reference, UnderTheMiddleOfATube) {
  // A thin line: I' / d (a + sin a cos a), a the angle to its end; I' cd/m across it. The skin of a
  // thick one is nearer.
  Lamp tube = point_lamp(Vec3(0, 0, 1), 1000.0);
  tube.type = Lamp::Type::kTube;
  tube.length = 1.2;
  tube.radius = 0.002;
  const Open open(tube);
  for (const double distance : {0.3, 1.0, 4.0}) {
    const double a = std::atan(0.6 / distance);
    const double across = 1000.0 / (M_PI * M_PI) / 1.2;
    const double expected = across / distance * (a + std::sin(a) * std::cos(a));
    EXPECT_NEAR(lux(open.lighting, facing(Vec3(0, 0, 1 - distance), Vec3::UnitZ())), expected,
                0.002 * expected);
  }
  EXPECT_NEAR(lux(open.lighting, facing(Vec3(30, 0, 1), -Vec3::UnitX())), 0.0, 1e-3);  // its end
}

// Small pieces of a tube's skin, along x at the origin: L cos cos / d^2 of each that faces the
// point.
double summed_tube(const Lamp& tube, const Vec3& point, const Vec3& normal) {
  constexpr int kAlong = 400, kAround = 360;
  double sum = 0.0;
  for (int i = 0; i < kAlong; ++i) {
    for (int k = 0; k < kAround; ++k) {
      const double angle = 2 * M_PI * (k + 0.5) / kAround;
      const Vec3 out(0, std::cos(angle), std::sin(angle));
      const Vec3 way =
          Vec3(tube.length * ((i + 0.5) / kAlong - 0.5), 0, 0) + tube.radius * out - point;
      const double leaves = -way.dot(out), arrives = way.dot(normal);
      if (leaves > 0 && arrives > 0) sum += leaves * arrives / std::pow(way.squaredNorm(), 2);
    }
  }
  return tube.luminous_flux / M_PI / (kAlong * kAround) * sum;
}

TEST(Reference, ATubesLightIsTheSumOverItsSkin) {
  Lamp tube = point_lamp(Vec3(0, 0, 0), 1000.0);
  tube.type = Lamp::Type::kTube;
  for (const auto& [length, radius] :
       {std::pair{1.2, 0.008}, {1.2, 0.013}, {0.6, 0.02}, {0.3, 0.06}}) {
    tube.length = length;
    tube.radius = radius;
    const Open open(tube);
    const double share = radius > 0.02 ? 0.005 : 0.002;
    for (const Vec3& point :
         {Vec3(1.1, 0, 0.05), Vec3(0.9, 0.1, 0), Vec3(0.4, 0, -0.1), Vec3(0, 0.08, 0),
          Vec3(-1.5, 0.5, 1), Vec3(0, 0, -0.3), Vec3(0, 0, -1), Vec3(0, 0, -4)}) {
      for (const Vec3& normal :
           {Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ()), Vec3(-Vec3::UnitZ()), Vec3(-Vec3::UnitX()),
            Vec3(-point.normalized()), Vec3(Vec3(-1, 1, 1).normalized())}) {
        const double expected = summed_tube(tube, point, normal);
        EXPECT_NEAR(lux(open.lighting, facing(point, normal)), expected, share * expected + 0.05)
            << length << " m at " << point.transpose() << ", facing " << normal.transpose();
      }
    }
  }
}

TEST(Reference, ATubesFluxIsTheIntegralOverASphere) {
  Lamp tube = point_lamp(Vec3(0, 0, 0), 1000.0);
  tube.type = Lamp::Type::kTube;
  tube.length = 0.6;
  tube.radius = 0.01;
  const Open open(tube);
  double flux = 0.0;
  constexpr int kRings = 200;
  for (int i = 0; i < kRings; ++i) {
    const double x = 1 - 2 * (i + 0.5) / kRings;
    const Vec3 out(x, std::sqrt(1 - x * x), 0);
    flux += lux(open.lighting, facing(3 * out, -out)) * 4 * M_PI * 9 / kRings;
  }
  EXPECT_NEAR(flux, 1000.0, 5.0);
}

TEST(Reference, ASpotHasHalfItsIntensityAtItsHalfAngle) {
  Lamp spot = point_lamp(Vec3(0, 0, 2), 800.0);
  spot.type = Lamp::Type::kSpot;
  spot.half_angle = 0.3;
  const Open open(spot);
  const double exponent = std::log(0.5) / std::log(std::cos(0.3));
  const double ahead = 800.0 * (exponent + 1) / (2 * M_PI);
  EXPECT_NEAR(lux(open.lighting, facing(Vec3(0, 0, 0), Vec3::UnitZ())), ahead / 4, 1e-6);
  const Vec3 out(std::sin(0.3), 0, -std::cos(0.3));
  EXPECT_NEAR(lux(open.lighting, facing(Vec3(0, 0, 2) + 2 * out, -out)), ahead / 8, 1e-6);
  EXPECT_EQ(lux(open.lighting, facing(Vec3(0, 0, 4), -Vec3::UnitZ())), 0.0);
}

/// A closed cube of 4 m about the origin, of slabs that meet without an overlap. They are as
/// thick as 1.5 times the spacing of points in the cells of the wider ones, so that a row of these
/// points is in the plane of the neighbor's inner side.
void add_flush_cube(rays::Scene& scene, const Eigen::Vector3f& albedo) {
  constexpr double kThick = 6.0 / 41;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 size = Vec3::Constant(4.0), at = Vec3::Zero();
    size.head(axis).array() += 2 * kThick;
    size[axis] = kThick;
    for (const double side : {-1.0, 1.0}) {
      at[axis] = side * (2.0 + kThick / 2);
      add_box(scene, at, size, albedo);
    }
  }
}

/// Reflected light in a closed cube of 4 m with 10,000 lm at its center, as the mean over points
/// spread evenly over all six walls.
double mean_indirect(float albedo, bool flush = false) {
  rays::Scene scene;
  if (flush) {
    add_flush_cube(scene, gray(albedo));
  } else {
    add_room(scene, Vec3(-2, -2, -2), Vec3(2, 2, 2), gray(albedo));
  }
  scene.commit();
  Lighting lighting(scene);
  lighting.add(point_lamp(Vec3(0, 0, 0), 10000.0), 1.0);
  constexpr int kSide = 6;
  double sum = 0.0;
  int count = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      for (int i = 0; i < kSide; ++i) {
        for (int j = 0; j < kSide; ++j) {
          Vec3 point;
          point[axis] = side * (2 - 1e-3);
          point[(axis + 1) % 3] = 4.0 * (i + 0.5) / kSide - 2;
          point[(axis + 2) % 3] = 4.0 * (j + 0.5) / kSide - 2;
          const double distance = point.norm();
          const double direct =
              10000.0 / (4 * M_PI) * std::abs(point[axis]) / std::pow(distance, 3);
          sum += lux(lighting, facing(point, -side * Vec3::Unit(axis))) - direct;
          ++count;
        }
      }
    }
  }
  return sum / count;
}

TEST(Reference, ClosedCubeOfAlbedoHalf) { EXPECT_NEAR(mean_indirect(0.5F), 104.17, 0.01 * 104.17); }

TEST(Reference, ClosedCubeOfHighAlbedo) {
  EXPECT_NEAR(mean_indirect(0.8F), 416.7, 0.01 * 416.7);
  EXPECT_NEAR(mean_indirect(0.9F), 937.5, 0.01 * 937.5);
}

TEST(Reference, ClosedCubeWhoseWallsMeetWithoutAnOverlap) {
  EXPECT_NEAR(mean_indirect(0.5F, true), 104.17, 0.01 * 104.17);
  EXPECT_NEAR(mean_indirect(0.9F, true), 937.5, 0.01 * 937.5);
}

TEST(Reference, ClosedCubeOfBlackHasNoIndirect) { EXPECT_NEAR(mean_indirect(0.0F), 0.0, 1e-6); }

TEST(Reference, ViewOfAnEvenWallIsItsLuminance) {
  // A wall that is far and large enough to be lit evenly over the whole view.
  rays::Scene scene;
  add_box(scene, Vec3(10.5, 0, 0), Vec3(1, 400, 400), gray(0.5F));
  scene.commit();
  Lighting lighting(scene);
  Lamp sun = point_lamp(Vec3(0, 0, 0), 1000.0);
  sun.type = Lamp::Type::kDirectional;
  sun.direction = Vec3::UnitX();
  lighting.add(sun, 1.0);
  const Sample sample = measure(lighting, facing(Vec3(0, 0, 0), Vec3::UnitX()));
  const double luminance = 1000 * 0.5 / M_PI;
  EXPECT_NEAR(sample.color.x(), luminance / (luminance + 50), 1e-4);
  EXPECT_NEAR(sample.illuminance, 1000 * 0.5, 0.03 * 500);  // the wall fills almost all it sees
}

TEST(Reference, ViewOfALampIsItsDiscsShareOfThePixel) {
  const Open open(point_lamp(Vec3(4, 0, 0), kThousandCandela));
  const Sample sample = measure(open.lighting, facing(Vec3(0, 0, 0), Vec3::UnitX()));
  // 1000 cd 4 m away behind a square pixel of 60 degrees: its area is (2 tan 30)^2 at 1 m.
  const double luminance = 1000.0 / 16 / (4.0 / 3);
  EXPECT_NEAR(sample.color.x(), luminance / (luminance + 50), 1e-5);
  const Sample beside = measure(open.lighting, facing(Vec3(0, 0, 0), Vec3(1, 1, 0)));
  EXPECT_EQ(beside.color.x(), 0.0F);
  EXPECT_GT(beside.illuminance, 0.0);
}

}  // namespace
}  // namespace angen::light::testing

// Direct light of partly hidden lamps against closed forms and a Monte Carlo sum of its own.
#include "light/shadow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "rooms.h"

namespace angen::light::testing {
namespace {

/// The tested claim: within 2 % or 0.05 lx, and the error of the expected value.
void expect_close(double measured, double expected, double deviation = 0.0) {
  EXPECT_NEAR(measured, expected, std::max(0.02 * expected, 0.05) + 3.0 * deviation);
}

Lamp panel(double width, double height, const Vec3& center, double flux) {
  Lamp lamp = point_lamp(center, flux);
  lamp.type = Lamp::Type::kRectangle;
  lamp.width = width;
  lamp.height = height;
  return lamp;
}

struct Summed {
  double lux = 0.0, deviation = 0.0;
};

/// Lambert's law at random points of the lamp's surface; a globe's are uniform on its sphere.
Summed summed(const rays::Scene& scene, const Lamp& lamp, const Pose& pose, int points) {
  Rng rng(3, hash_bytes("summed"), 0);
  const Vec3 normal = pose.rotation * Vec3::UnitX();
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < points; ++i) {
    Vec3 offset, outward = Vec3(0, 0, -1);
    const double u = rng.uniform(), v = rng.uniform(), turn = 2.0 * M_PI * v;
    double area = 0.0;
    switch (lamp.type) {
      case Lamp::Type::kRectangle:
        offset = Vec3((u - 0.5) * lamp.width, (v - 0.5) * lamp.height, 0);
        area = lamp.width * lamp.height;
        break;
      case Lamp::Type::kDisc:
        offset = lamp.radius * std::sqrt(u) * Vec3(std::cos(turn), std::sin(turn), 0);
        area = M_PI * lamp.radius * lamp.radius;
        break;
      case Lamp::Type::kTube:
        outward = Vec3(0, std::cos(turn), std::sin(turn));
        offset = Vec3((u - 0.5) * lamp.length, 0, 0) + lamp.radius * outward;
        area = 2.0 * M_PI * lamp.radius * lamp.length;
        break;
      default:
        outward = Vec3(std::sqrt(u * (1 - u)) * 2 * std::cos(turn),
                       std::sqrt(u * (1 - u)) * 2 * std::sin(turn), 1 - 2 * u);
        offset = lamp.radius * outward;
        area = 4.0 * M_PI * lamp.radius * lamp.radius;
    }
    const Vec3 way = lamp.pose.position + offset - pose.position;
    const double distance = way.norm();
    const double cosines = std::max(0.0, way.dot(normal)) * std::max(0.0, -way.dot(outward));
    if (cosines == 0.0 || scene.blocked(pose.position, pose.position + way, 1e-4)) continue;
    const double part = lamp.luminous_flux / M_PI * cosines / std::pow(distance, 4);
    EXPECT_GT(area, 0.0);
    sum += part;
    squares += part * part;
  }
  const double mean = sum / points;
  return {mean, std::sqrt((squares / points - mean * mean) / points)};
}

/// A room without reflections.
struct Dark {
  double at(const Lamp& lamp, const Pose& pose) {
    scene.commit();
    Lighting lighting(scene);
    lighting.add(lamp, 1.0);
    return lux(lighting, pose);
  }
  void check(const Lamp& lamp, const Pose& pose, int points = 40'000) {
    const double measured = at(lamp, pose);
    const Summed expected = summed(scene, lamp, pose, points);
    expect_close(measured, expected.lux, expected.deviation);
  }
  rays::ShapeId add(const Vec3& center, const Vec3& size) {
    return add_box(scene, center, size, gray(0.0F));
  }
  rays::Scene scene;
};

/// lx on a table under a square panel, of which slats along x, each from `low` to `high` m in y at
/// `drop` m below it, hide strips: the sum over points of the rest.
double under_slats(const Lamp& lamp, const Vec3& point, double drop,
                   const std::vector<std::pair<double, double>>& slats) {
  constexpr int kSteps = 4000, kAlong = 200;
  const double below = lamp.pose.position.z() - point.z();
  const double scale = below / (below - drop);
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double y = lamp.height * ((i + 0.5) / kSteps - 0.5) - point.y();
    const double crosses = point.y() + y / scale;
    const bool hidden = std::any_of(slats.begin(), slats.end(), [&](const auto& slat) {
      return slat.first < crosses && crosses < slat.second;
    });
    for (int k = 0; k < kAlong && !hidden; ++k) {
      const double x = lamp.width * ((k + 0.5) / kAlong - 0.5) - point.x();
      sum += below * below / std::pow(x * x + y * y + below * below, 2);
    }
  }
  return lamp.luminous_flux / M_PI * sum / (kSteps * kAlong);
}

TEST(Shadow, SlatsUnderAPanel) {
  const Lamp lamp = panel(1.2, 1.2, Vec3(0, 0, 2.4), 3000.0);
  for (const double width : {0.02, 0.025, 0.08, 0.15}) {
    for (const double drop : {0.05, 0.4, 1.2}) {
      Dark dark;
      std::vector<std::pair<double, double>> slats;
      for (double y = -1.0 + 0.3 * width; y < 1.0; y += 2.0 * width) {
        slats.emplace_back(y, y + width);
        dark.add(Vec3(0, y + width / 2, 2.4 - drop), Vec3(3, width, 1e-6));
      }
      for (const Vec3& point : {Vec3(0, 0, 0.75), Vec3(0.3, 0.45, 0.75)}) {
        SCOPED_TRACE(::testing::Message() << width << " at " << drop << " " << point.y());
        expect_close(dark.at(lamp, facing(point, Vec3::UnitZ())),
                     under_slats(lamp, point, drop, slats));
      }
    }
  }
}

/// The share of a uniform disc beyond a straight edge at that part of its radius from the middle.
double beyond(double edge) {
  return (std::acos(edge) - edge * std::sqrt(1.0 - edge * edge)) / M_PI;
}

TEST(Shadow, TheEdgeOfAWallBeforeAGlobe) {
  Lamp lamp = point_lamp(Vec3(0, 0, 2), 3000.0);
  for (const double radius : {0.05, 0.3}) {
    lamp.radius = radius;
    for (double edge = -0.95; edge < 1.0; edge += 0.05) {
      Dark dark;
      // From the origin, the plane through the edge and the point has the globe's center at a
      // distance of edge times its radius.
      const double angle = std::asin(edge * radius / 2.0);
      const double y = std::tan(angle);
      dark.add(Vec3(0, y - 5, 1), Vec3(10, 10, 1e-6));
      SCOPED_TRACE(::testing::Message() << radius << ", edge at " << edge);
      const double free = 3000.0 / (4.0 * M_PI * 4.0);
      // The seen cone is narrow, so that its part beyond a plane is that of a disc.
      const double off = std::tan(angle) / std::tan(std::asin(radius / 2.0));
      expect_close(dark.at(lamp, facing(Vec3::Zero(), Vec3::UnitZ())), free * beyond(off),
                   radius > 0.1 ? 0.003 * free * (1 - beyond(off)) / 3 : 0.0);
    }
  }
}

TEST(Shadow, AWardrobeHidesAThirdOfAPanel) {
  Dark dark;
  dark.add(Vec3(1.0, 0, 1.0), Vec3(0.6, 1.2, 2.0));
  dark.check(panel(1.2, 1.2, Vec3(0, 0, 2.4), 3000.0), facing(Vec3(2.2, 0, 0.75), Vec3::UnitZ()));
  dark.check(panel(1.2, 1.2, Vec3(0, 0, 2.4), 3000.0), facing(Vec3(2.6, 0, 0.6), Vec3::UnitZ()));
}

TEST(Shadow, APersonNearAWindow) {
  Lamp window = panel(1.0, 1.4, Vec3(0, 1.5, 1.5), 2000.0);
  window.pose.rotation = Quat::FromTwoVectors(-Vec3::UnitZ(), Vec3::UnitX());
  for (const double x : {0.4, 1.0, 1.8}) {
    Dark dark;
    dark.add(Vec3(x, 1.4, 0.85), Vec3(0.3, 0.5, 1.7));
    const double measured = dark.at(window, facing(Vec3(2.5, 1.6, 1.0), -Vec3::UnitX()));
    // The direction turned by the window's rotation, in which the lamp shines down.
    rays::Scene turned;
    const Quat back = window.pose.rotation.conjugate();
    turned.add(box(Vec3(0.3, 0.5, 1.7)), {back * (Vec3(x, 1.4, 0.85) - window.pose.position), back},
               rays::Mobility::kStatic, gray(0.0F));
    turned.commit();
    Lamp down = window;
    down.pose = {};
    const Summed expected =
        summed(turned, down,
               facing(back * (Vec3(2.5, 1.6, 1.0) - window.pose.position), back * -Vec3::UnitX()),
               100'000);
    expect_close(measured, expected.lux, expected.deviation);
  }
}

TEST(Shadow, ASlitBetweenBoards) {
  const Lamp lamp = panel(1.2, 0.6, Vec3(0, 0, 2.4), 3000.0);
  for (const double slit : {0.01, 0.02, 0.05}) {
    Dark dark;
    dark.add(Vec3(0.83, 0.1, 1.6), Vec3(1.6 - slit, 3, 0.02));
    dark.add(Vec3(-0.77, 0.1, 1.6), Vec3(1.6 - slit, 3, 0.02));
    dark.check(lamp, facing(Vec3(0.05, 0.1, 0.75), Vec3::UnitZ()), 200'000);
  }
}

/// Whether a shape is in the lamp: what such a lamp loses is a convention.
bool touches(const rays::Scene& scene, const Lamp& lamp) {
  for (double along = -0.5; along <= 0.5; along += 0.01) {
    const double reach = lamp.type == Lamp::Type::kTube ? lamp.length * along : 0.0;
    for (double turn = 0.0; turn < 2.0 * M_PI; turn += 0.3) {
      for (double rise = -1.5; rise < 1.6; rise += 0.3) {
        const Vec3 out(std::cos(turn) * std::cos(rise), std::sin(turn) * std::cos(rise),
                       std::sin(rise));
        const Vec3 from = lamp.pose.position + Vec3(reach, 0, 0);
        if (scene.covered(from, UINT32_MAX)) return true;
        if (!lamp.flat() && scene.blocked(from, from + lamp.radius * out, 0.0)) return true;
      }
    }
    if (reach == 0.0) break;
  }
  return false;
}

/// Any lamp of area, and boxes and rods of 2 cm and more anywhere between it and the place.
TEST(Shadow, AnyOccluders) {
  Rng rng(1, hash_bytes("occluders"), 0);
  const auto between = [&](double low, double high) { return low + (high - low) * rng.uniform(); };
  for (int trial = 0; trial < 160; ++trial) {
    Lamp lamp = panel(between(0.3, 1.5), between(0.3, 1.2), Vec3(0, 0, 2.4), between(300, 4000));
    if (trial % 4 == 1) {
      lamp.type = Lamp::Type::kDisc;
      lamp.radius = between(0.05, 0.5);
    } else if (trial % 4 == 2) {
      lamp.type = Lamp::Type::kTube;
      lamp.length = between(0.3, 1.5);
      lamp.radius = 0.013;
    } else if (trial % 4 == 3) {
      lamp.type = Lamp::Type::kPoint;
      lamp.radius = between(0.03, 0.3);
    }
    Dark dark;
    const Vec3 point(between(-1.5, 1.5), between(-1.5, 1.5), between(0.0, 1.9));
    const int count = 1 + static_cast<int>(rng.next() % 6);
    for (int i = 0; i < count; ++i) {
      const double along = between(0.1, 0.8);
      const Vec3 spread(between(-0.3, 0.3), between(-0.3, 0.3), 0.0);
      const Vec3 at = point + along * (lamp.pose.position + spread - point);
      const Vec3 size(between(0.02, 0.3), between(0.02, 1.0), between(0.02, 0.3));
      dark.scene.add(box(size), {at, from_rpy(between(-3, 3), between(-1, 1), between(-3, 3))},
                     rays::Mobility::kStatic, gray(0.0F));
    }
    dark.scene.commit();
    if (dark.scene.covered(point, UINT32_MAX) || touches(dark.scene, lamp)) continue;
    SCOPED_TRACE(::testing::Message() << "trial " << trial);
    const Vec3 normal(between(-0.5, 0.5), between(-0.5, 0.5), 1.0);
    dark.check(lamp, facing(point, normal.normalized()), 60'000);
  }
}

}  // namespace
}  // namespace angen::light::testing

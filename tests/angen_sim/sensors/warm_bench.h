#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench.h"

/// A pyroelectric PIR and the warm things that it sees.
namespace angen::test {

using Parameters = std::vector<std::pair<std::string, std::string>>;

inline const char* const kPir = "libpir_controller.so";
constexpr Nanoseconds kSample = kSecond / 100;
constexpr double kOpening = 1e-5;  // m^2, facet_area times transmission
constexpr double kHeight = 2.2;    // m, above the floor

/// A pyroelectric PIR that is warm and makes no noise, but for what `more` says.
inline Element pyroelectric(const Parameters& more) {
  Parameters all = {{"model", "pyroelectric"}, {"facet_area", "2e-5"}, {"transmission", "0.5"}};
  const auto has = [&](const std::string& key) {
    for (const auto& pair : more) {
      if (pair.first == key) return true;
    }
    return false;
  };
  if (!has("noise_stddev")) all.emplace_back("noise_stddev", "0");
  if (!has("warm_up")) all.emplace_back("warm_up", "0");
  all.insert(all.end(), more.begin(), more.end());
  return plugin_element(all);
}

/// One pair of zones, 0.4 rad wide each, in the middle of 0.8 rad: positive to the right.
inline const std::pair<std::string, std::string> kWidePair{"zone_row", "1 -0.8 0.8 -0.5 0.5"};

inline Shape sphere(double radius) {
  Shape shape;
  shape.type = Shape::Type::kSphere;
  shape.radius = radius;
  return shape;
}

inline Shape person() {
  Shape shape;
  shape.type = Shape::Type::kCapsule;
  shape.radius = 0.25;
  shape.length = 1.25;
  return shape;
}

inline rays::ShapeId add_warm(Bench& bench, const Shape& shape, const Pose& pose,
                              double temperature) {
  const rays::ShapeId id = bench.add(shape, pose);
  bench.scene.warm(id, Warming::constant(temperature));
  return id;
}

}  // namespace angen::test

#include "light/hemisphere.h"

#include <cmath>

#include "light/directions.h"

namespace angen::light {
namespace {

// Points i / n, radical inverse of i, have one in each cell of the lattice, and one of n / 128
// successive ones: the first digits of i are its ring, the last ones its part of the circle.
constexpr std::size_t kParts = 128;  // parts of a circle
static_assert(kDirections % kParts == 0);

std::size_t reversed(std::size_t part) {
  std::size_t out = 0;
  for (std::size_t bit = 1; bit < kParts; bit *= 2) out = 2 * out + (part & bit ? 1 : 0);
  return out;
}

Vec3 about_x(const Vec3& about_z) { return {about_z.z(), about_z.x(), about_z.y()}; }

const double kViewTangent = std::tan(M_PI / 6);  // half of 60 degrees

}  // namespace

bool in_view(const Vec3& local) {
  const double edge = local.x() * kViewTangent;
  return local.x() > 0 && std::abs(local.y()) <= edge && std::abs(local.z()) <= edge;
}

double view_area() { return 4 * kViewTangent * kViewTangent; }

const std::vector<Vec3>& gather_directions() {
  static const std::vector<Vec3> all = [] {
    std::vector<Vec3> turned;
    for (const Vec3& d : cosine_directions(kDirections)) turned.push_back(about_x(d));
    return turned;
  }();
  return all;
}

const std::vector<std::array<std::size_t, 4>>& neighbors() {
  static const std::vector<std::array<std::size_t, 4>> all = [] {
    std::vector<std::array<std::size_t, 4>> found;
    for (std::size_t i = 0; i < kDirections; ++i) {
      const std::size_t ring = i / kParts * kParts, around = reversed(i % kParts);
      found.push_back({ring + reversed((around + 1) % kParts),
                       ring + reversed((around + kParts - 1) % kParts), i < kParts ? i : i - kParts,
                       i + kParts < kDirections ? i + kParts : i});
    }
    return found;
  }();
  return all;
}

std::array<Vec3, kFineDirections> fine_directions(std::size_t i) {
  constexpr std::size_t kAll = kDirections * kFineDirections;
  std::array<Vec3, kFineDirections> all;
  for (std::size_t k = 0; k < kFineDirections; ++k) {
    const std::size_t at = (i / kParts * kFineDirections + k) * kParts + i % kParts;
    all[k] = about_x(cosine_direction((static_cast<double>(at) + 0.5) / kAll,
                                      radical_inverse(static_cast<unsigned>(at))));
  }
  return all;
}

/// Corrects the cosine weights of the directions: an image plane weighs all its points equally.
const std::vector<float>& view_weights() {
  static const std::vector<float> weights = [] {
    std::vector<double> all;
    double sum = 0.0;
    for (const Vec3& local : gather_directions()) {
      all.push_back(in_view(local) ? 1.0 / std::pow(local.x(), 4) : 0.0);
      sum += all.back();
    }
    std::vector<float> shares;
    shares.reserve(all.size());
    for (const double weight : all) shares.push_back(static_cast<float>(weight / sum));
    return shares;
  }();
  return weights;
}

}  // namespace angen::light

#include "light/hemisphere.h"

#include <cmath>

#include "light/directions.h"

namespace angen::light {
namespace {

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
    for (const Vec3& d : cosine_directions(kDirections)) turned.emplace_back(d.z(), d.x(), d.y());
    return turned;
  }();
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

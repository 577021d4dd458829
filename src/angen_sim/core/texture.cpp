#include "core/texture.h"

#include <algorithm>
#include <cmath>

namespace angen {

namespace {

std::array<float, 256> make_linear() {
  std::array<float, 256> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double v = static_cast<double>(i) / 255.0;
    values[i] = static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
  }
  return values;
}

Eigen::Vector3f texel(const Texture& texture, std::size_t column, std::size_t row) {
  const std::uint8_t* at = &texture.bytes[3 * (row * texture.width + column)];
  return {linear(at[0]), linear(at[1]), linear(at[2])};
}

// The texel before a place in 0..1, the one after, and how far it is between their middles.
struct Between {
  Between(float place, std::uint32_t count) {
    const double whole = static_cast<double>(place) - std::floor(static_cast<double>(place));
    const double middle = (std::isfinite(whole) ? whole : 0.0) * count - 0.5;
    const double floor = std::floor(middle);
    before = static_cast<std::size_t>(floor < 0.0 ? count - 1 : floor);
    after = before + 1 == count ? 0 : before + 1;
    part = static_cast<float>(middle - floor);
  }
  std::size_t before;
  std::size_t after;
  float part;
};

}  // namespace

float linear(std::uint8_t srgb) {
  static const std::array<float, 256> values = make_linear();
  return values[srgb];
}

std::uint8_t srgb(double linear_value) {
  const double v = std::clamp(linear_value, 0.0, 1.0);
  const double encoded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * encoded));
}

Eigen::Vector3f Texture::at(float u, float v) const {
  const Between x(u, width);
  const Between y(1.0F - v, height);
  const auto across = [&](std::size_t row) -> Eigen::Vector3f {
    return (1.0F - x.part) * texel(*this, x.before, row) + x.part * texel(*this, x.after, row);
  };
  return (1.0F - y.part) * across(y.before) + y.part * across(y.after);
}

Eigen::Vector3f Texture::mean() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t row = 0; row < height; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      sum += texel(*this, column, row).cast<double>();
    }
  }
  return (sum / (static_cast<double>(width) * height)).cast<float>();
}

}  // namespace angen

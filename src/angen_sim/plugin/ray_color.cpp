#include "plugin/ray_color.h"

#include <sstream>

#include "core/text.h"

namespace angen {

Eigen::Vector4f read_ray_color(Params& params, const Kind& kind) {
  const std::string text =
      params.text("color", kind.ray_color(), "of its rays in rviz: red green blue alpha, 0 to 1");
  std::istringstream words(text);
  Eigen::Vector4f color(0.0F, 0.0F, 0.0F, 1.0F);
  int count = 0;
  bool good = true;
  for (std::string word; words >> word; ++count) {
    const std::optional<double> share = parse_finite(word);
    good = good && count < 4 && share && *share >= 0.0 && *share <= 1.0;
    if (good) color[count] = static_cast<float>(*share);
  }
  if (good && count >= 3) return color;
  throw params.error("color", "<color> is \"" + text + "\", must be 3 or 4 numbers from 0 to 1");
}

}  // namespace angen

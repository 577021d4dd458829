#include "assets/ies.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <sstream>
#include <vector>

#include "core/diagnostics.h"
#include "core/lists.h"
#include "core/text.h"
#include "document/values.h"

namespace angen::load {

namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr std::size_t kMaxAngles = 2000;
constexpr std::size_t kMaxNumbers = 200'000;
constexpr double kMaxCandela = 1e9;

/// The numbers after the line of TILT, one by one, each with its line.
class IesNumbers {
 public:
  IesNumbers(const std::string& text, const std::string& file) : in_(text), file_(file) {}

  /// Reads up to TILT=NONE.
  void skip_head() {
    std::string text;
    while (next_line(text)) {
      if (text.rfind("TILT=", 0) != 0) continue;
      if (text == "TILT=NONE") return;
      fail("'" + printable(text) + "' is not modeled; write TILT=NONE");
    }
    fail("there is no line TILT=NONE; this is not a file of IES LM-63");
  }

  double next(const std::string& what) {
    std::string word;
    while (!(words_ >> word)) {
      std::string text;
      if (!next_line(text)) fail("the file ends where " + what + " should be");
      std::replace(text.begin(), text.end(), ',', ' ');
      words_ = std::istringstream(text);
    }
    if (++count_ > kMaxNumbers) fail("there are more than 200000 numbers");
    const Numbers numbers = numbers_in(word);
    if (numbers.values.size() != 1 || !numbers.bad.empty() || !std::isfinite(numbers.values[0])) {
      fail("'" + printable(word, 40) + "' is not a number; " + what + " should be here");
    }
    return numbers.values[0];
  }

  std::size_t next_count(const std::string& what) {
    const double value = next(what);
    if (!(value >= 1.0 && value <= kMaxAngles && value == std::floor(value))) {
      fail(what + " is not a whole number from 1 to 2000");
    }
    return static_cast<std::size_t>(value);
  }

  std::vector<double> next_angles(std::size_t count, const std::string& what) {
    std::vector<double> angles;
    for (std::size_t i = 0; i < count; ++i) {
      angles.push_back(next(what));
      if (i > 0 && !(angles[i] > angles[i - 1])) fail(what + " do not ascend");
    }
    return angles;
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw Error({file_, std::max(line_, 1)}, message);
  }

 private:
  bool next_line(std::string& text) {
    if (!std::getline(in_, text)) return false;
    ++line_;
    const std::size_t end = text.find_last_not_of(" \t\r");
    text.erase(end == std::string::npos ? 0 : end + 1);
    return true;
  }

  std::istringstream in_, words_;
  std::string file_;
  int line_ = 0;
  std::size_t count_ = 0;
};

bool one_of(double value, const std::vector<double>& known) { return is_in(value, known); }

/// Planes from 90 to 270 degrees are one half of a luminaire that is symmetric about their plane:
/// makes all planes from 0 to 360 degrees of them.
void add_other_half(Photometry& luminaire) {
  std::map<double, std::vector<double>> planes;  // by angle
  const auto rows = static_cast<std::ptrdiff_t>(luminaire.vertical.size());
  auto first = luminaire.candela.begin();
  for (const double angle : luminaire.horizontal) {
    planes[angle] = planes[std::fmod(540.0 - angle, 360.0)] = {first, first + rows};
    first += rows;
  }
  if (planes.count(0.0) == 0) {  // between the mirrored planes beside it
    const auto low = std::prev(planes.lower_bound(180.0)), high = planes.upper_bound(180.0);
    const double share = (180.0 - low->first) / (high->first - low->first);
    std::vector<double>& middle = planes[0.0];
    for (std::size_t i = 0; i < luminaire.vertical.size(); ++i) {
      middle.push_back((1.0 - share) * low->second[i] + share * high->second[i]);
    }
    planes[180.0] = middle;
  }
  planes[360.0] = planes[0.0];
  luminaire.horizontal.clear();
  luminaire.candela.clear();
  for (const auto& [angle, candela] : planes) {
    luminaire.horizontal.push_back(angle);
    luminaire.candela.insert(luminaire.candela.end(), candela.begin(), candela.end());
  }
}

}  // namespace

Photometry photometry_of(const std::string& text, const std::string& file) {
  IesNumbers in(text, file);
  in.skip_head();
  in.next("the number of lamps");
  in.next("the lumens of a lamp");
  const double multiplier = in.next("the multiplier of candela");
  if (!(multiplier > 0.0 && multiplier < kMaxCandela)) in.fail("the multiplier is not above 0");
  const std::size_t rows = in.next_count("the number of vertical angles");
  const std::size_t planes = in.next_count("the number of horizontal angles");
  if (in.next("the photometric type") != 1.0) {
    in.fail("only photometric type 1 (C) is read; convert the file to type C");
  }
  if (!one_of(in.next("the unit of length"), {1.0, 2.0})) in.fail("the unit is not 1 or 2");
  for (const char* what : {"the width", "the length", "the height", "the ballast factor",
                           "the ballast-lamp factor", "the input watts"}) {
    in.next(what);
  }
  Photometry out;
  out.vertical = in.next_angles(rows, "the vertical angles");
  if (!one_of(out.vertical.front(), {0.0, 90.0}) || !one_of(out.vertical.back(), {90.0, 180.0})) {
    in.fail("the vertical angles do not go from 0 or 90 to 90 or 180 degrees");
  }
  out.horizontal = in.next_angles(planes, "the horizontal angles");
  const bool is_half = out.horizontal.front() == 90.0 && out.horizontal.back() == 270.0;
  if (!is_half && (out.horizontal.front() != 0.0 ||
                   !one_of(out.horizontal.back(), {0.0, 90.0, 180.0, 360.0}))) {
    in.fail(
        "the horizontal angles do not go from 0 to 0, 90, 180 or 360 degrees, nor from 90 to 270");
  }
  if (rows < 2) in.fail("there is only one vertical angle; give at least two");
  for (std::size_t i = 0; i < rows * planes; ++i) {
    const double candela = multiplier * in.next("an intensity");
    if (!(candela >= 0.0 && candela <= kMaxCandela))
      in.fail("an intensity is below 0 or too large");
    out.candela.push_back(candela);
  }
  if (*std::max_element(out.candela.begin(), out.candela.end()) <= 0.0) {
    in.fail("all intensities are 0");
  }
  if (is_half) add_other_half(out);
  for (double& angle : out.vertical) angle *= kDegree;
  for (double& angle : out.horizontal) angle *= kDegree;
  return out;
}

}  // namespace angen::load

#pragma once

#include <vector>

namespace angen {

/// Luminous intensities of a luminaire, type C of LM-63: by the angle from the direction in which
/// it shines, and by the angle about that from its own x axis.
struct Photometry {
  std::vector<double> vertical;    // rad, ascending, within 0 to pi
  std::vector<double> horizontal;  // rad, ascending from 0 to 0, pi/2, pi or 2 pi
  std::vector<double> candela;     // cd, by horizontal angle and then by vertical one

  bool operator==(const Photometry& o) const {
    return vertical == o.vertical && horizontal == o.horizontal && candela == o.candela;
  }
};

}  // namespace angen

#pragma once

#include <cmath>

namespace angen::render {

/// A pinhole camera that looks along x, with y to the left and z up. Pixel (column, row), counted
/// from 0 at the top left, is looked at through its center; the axis passes at center_x, center_y.
struct PinholeCamera {
  int width = 320;
  int height = 240;
  double horizontal_angle = 1.047;  // rad, full, < pi
  double near = 0.05;               // m along the axis; nearer is not seen
  double far = 100.0;

  /// In pixels; the same for rows and columns.
  double focal() const { return 0.5 * width / std::tan(0.5 * horizontal_angle); }
  double center_x() const { return 0.5 * (width - 1); }
  double center_y() const { return 0.5 * (height - 1); }
};

}  // namespace angen::render

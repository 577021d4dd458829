#pragma once

#include <cmath>

namespace angen::render {

/// Lens distortion by Brown and Conrady's coefficients, as in OpenCV.
struct Distortion {
  double k1 = 0.0, k2 = 0.0, p1 = 0.0, p2 = 0.0, k3 = 0.0;

  bool none() const { return k1 == 0.0 && k2 == 0.0 && p1 == 0.0 && p2 == 0.0 && k3 == 0.0; }
  /// Position at which a point is shown; both are in focal lengths, right of the axis and down.
  void distort(double x, double y, double& shown_x, double& shown_y) const {
    const double r2 = x * x + y * y;
    const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
    shown_x = x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x);
    shown_y = y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y;
  }
  /// The point that is shown there; without distortion if the iteration does not converge.
  void undistort(double shown_x, double shown_y, double& x, double& y) const {
    x = shown_x;
    y = shown_y;
    for (int i = 0; i < 20; ++i) {
      double there_x = 0.0, there_y = 0.0;
      distort(x, y, there_x, there_y);
      x += shown_x - there_x;
      y += shown_y - there_y;
    }
    if (std::isfinite(x) && std::isfinite(y) && std::hypot(x, y) < 1e3) return;
    x = shown_x;
    y = shown_y;
  }
};

/// A pinhole camera that looks along x, with y to the left and z up. The ray of pixel (column,
/// row), counted from 0 at the top left, passes through its center; the axis is at center_x,
/// center_y.
struct PinholeCamera {
  int width = 320;
  int height = 240;
  double horizontal_angle = 1.047;  // rad, full, < pi
  double near = 0.05;               // m along the axis; nearer surfaces are invisible
  double far = 100.0;
  Distortion distortion;

  /// Focal length in pixels, equal for rows and columns.
  double focal() const { return 0.5 * width / std::tan(0.5 * horizontal_angle); }
  double center_x() const { return 0.5 * (width - 1); }
  double center_y() const { return 0.5 * (height - 1); }
};

}  // namespace angen::render

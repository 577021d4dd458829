#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace angen {

/// Errors of a pose that is counted from two wheels. The variance of a wheel's way grows with it:
/// R. Siegwart, I. Nourbakhsh, Introduction to Autonomous Mobile Robots, 2004, equations 5.8, 5.9.
class WheelErrors {
 public:
  WheelErrors() = default;
  /// `after_meter`: m, standard deviation of a wheel's way after 1 m. An infinite separation (m):
  /// the heading is measured otherwise.
  WheelErrors(double after_meter, double separation)
      : per_meter_(after_meter * after_meter), turn_(1.0 / separation) {}

  /// The wheels roll so far (m), with this heading (rad) in the middle of it.
  void roll(double left, double right, double heading) {
    const double way = (left + right) / 2.0;
    const Eigen::Vector3d ahead(std::cos(heading), std::sin(heading), 0.0);
    const Eigen::Vector3d aside(-std::sin(heading), std::cos(heading), 0.0);
    Eigen::Matrix3d by_pose = Eigen::Matrix3d::Identity();
    by_pose.col(2) += way * aside;
    const Eigen::Vector3d by_turn = way / 2.0 * aside + Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d by_right = ahead / 2.0 + turn_ * by_turn;
    const Eigen::Vector3d by_left = ahead / 2.0 - turn_ * by_turn;
    covariance_ = by_pose * covariance_ * by_pose.transpose();
    covariance_ += per_meter_ * std::abs(right) * by_right * by_right.transpose();
    covariance_ += per_meter_ * std::abs(left) * by_left * by_left.transpose();
  }

  /// Covariance of x, y (m) and yaw (rad), row by row.
  std::vector<double> numbers() const { return {covariance_.data(), covariance_.data() + 9}; }

 private:
  double per_meter_ = 0.0;  // m
  double turn_ = 0.0;       // rad/m
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
};

}  // namespace angen

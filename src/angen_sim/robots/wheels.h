#pragma once

#include <vector>

#include "robots/base.h"

namespace angen::robots {

/// Driven wheels on both sides of a robot: speeds come in, wheel motors turn.
class Wheels : public Device {
 public:
  Verdict command(const Command& command, const View& view) override;
  void update(const View& view, Outputs& outputs) override;
  void report(const View& view, Reading& state) const override;
  Nanoseconds idle_until(const View&) const override { return ramping_ ? 0 : kForever; }

 protected:
  struct Geometry {
    double separation = 0.0;    // m
    double radius = 0.0;        // m
    double torque = 0.0;        // N m
    double acceleration = 0.0;  // m/s^2 at the rim; 0 = at once
  };
  void set_up(const Geometry& geometry, std::vector<JointRef> left, std::vector<JointRef> right);

 private:
  struct Side {
    std::vector<JointRef> joints;
    double speed = 0.0;  // m/s at the rim, as the motors are commanded
  };
  bool lead(Side& side, double wanted, double step, Outputs& outputs) const;

  Geometry geometry_;
  Side left_;
  Side right_;
  bool ramping_ = true;  // some motor has not its speed yet
  bool started_ = false;
  double v_ = 0.0;  // m/s, wanted
  double w_ = 0.0;  // rad/s, wanted
};

/// The kind of a device that is commanded by a speed and a turn.
Kind wheels_kind(std::string name, std::string doc);

}  // namespace angen::robots

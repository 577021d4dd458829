#pragma once

#include <vector>

#include "rays/scene.h"

namespace angen::sensors {

/// Losses of the multi-wall model of COST 231 (final report, chapter 4), dB.
struct PathLoss {
  double light_wall = 3.4;  // up to about 10 cm; also doors, furniture, people
  double heavy_wall = 6.9;  // thicker
  double floor = 18.3;
  double floor_exponent = 0.46;  // further floors add less
};

/// Loss in free space, dB; distance in m, frequency in MHz.
double free_space_loss(double distance, double frequency);

/// Obstacles in a path, by thickness and attitude.
struct Obstacles {
  int light = 0;
  int heavy = 0;
  int floors = 0;
};

/// `way` is the path's unit vector; crossings are in its order. Shapes that overlap are one, as
/// are those that touch face to face and make a wall of at most 0.5 m.
Obstacles obstacles_on(const std::vector<rays::Crossing>& crossings, const Vec3& way);

/// dB that the obstacles add to the loss in free space.
double loss_of(const Obstacles& obstacles, const PathLoss& losses);

}  // namespace angen::sensors

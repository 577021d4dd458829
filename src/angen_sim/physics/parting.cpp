#include "physics/parting.h"

#include <algorithm>
#include <map>

#include "physics/islands.h"
#include "physics/joints.h"

namespace angen::physics {

namespace {

// m beyond the layer: where parting begins, and where it ends.
constexpr double kIn = 5e-5;
constexpr double kOut = 1e-5;
// Steps to part from the last overlap on, in which joints and their stops correct their bend.
constexpr int kAfter = 20;

// m from its center of mass to the farthest point of its geoms' boxes.
double radius_of(const Body& body) {
  double radius = 0.0;
  for (const Geom* geom : body.geoms) {
    const Vec3 low = (geom->box.min - body.at.position).cwiseAbs();
    const Vec3 high = (geom->box.max - body.at.position).cwiseAbs();
    radius = std::max(radius, low.cwiseMax(high).norm());
  }
  return radius;
}

// Joints, too, correct their positions only in the first step.
void set_correction(const std::vector<Body*>& bodies, bool on) {
  dWorldSetERP(dBodyGetWorld(bodies.front()->ode.get()), on ? kJointErp : 0.0);
  for (const Body* body : bodies) {
    for (const Joint* joint : body->joints) {
      if (joint->first == body) correct_positions(*joint, on);
    }
  }
}

Quat turned(const Quat& rotation, const Vec3& angle) {
  const double norm = angle.norm();
  if (norm < 1e-12) return rotation;
  return Quat(Eigen::AngleAxisd(norm, angle / norm)) * rotation;
}

}  // namespace

bool mark_parting(const std::vector<Body*>& awake, const Contacts& contacts) {
  bool maybe = false;
  for (Body* body : awake) {
    body->parts = false;
    body->pushed = 0.0;
    body->overlaps = body->overlap > (body->overlaps ? kOut : kIn);
    maybe = maybe || body->overlaps || body->parting_steps > 0;
  }
  if (!maybe) return false;
  const Islands islands(awake, contacts.active());
  std::vector<char> overlapping(awake.size(), 0), parting(awake.size(), 0);
  for (const Body* body : awake) {
    if (body->overlaps) overlapping[islands.of(*body)] = 1;
  }
  for (Body* body : awake) {
    const std::uint32_t island = islands.of(*body);
    body->parting_steps = std::max(0, body->parting_steps - 1);
    if (overlapping[island] != 0) body->parting_steps = body->joints.empty() ? 1 : kAfter;
    if (body->parting_steps > 0) parting[island] = 1;
  }
  bool any = false;
  for (Body* body : awake) {
    body->parts = parting[islands.of(*body)] != 0;
    any = any || body->parts;
  }
  return any;
}

void part(const std::vector<Body*>& awake, const std::vector<BodyState>& start, double fastest,
          double h, const std::function<void()>& solve) {
  struct Pushed {
    Body* body;
    const BodyState* start;
    Vec3 velocity, spin;  // with the push, then by it alone
  };
  std::vector<Pushed> pushed;
  std::vector<Body*> bodies;
  for (std::size_t i = 0; i < awake.size(); ++i) {
    awake[i]->again = awake[i]->parts;
    if (!awake[i]->parts) continue;
    pushed.push_back({awake[i], &start[i], awake[i]->velocity(), awake[i]->spin()});
    bodies.push_back(awake[i]);
  }
  set_correction(bodies, false);
  solve();
  set_correction(bodies, true);
  std::map<const Mechanism*, double> speeds;  // m/s, of its points, by the push
  for (Pushed& each : pushed) {
    each.velocity -= each.body->velocity();
    each.spin -= each.body->spin();
    double& most = speeds[each.body->mechanism];
    most = std::max(most, each.velocity.norm() + each.spin.norm() * radius_of(*each.body));
  }
  for (const Pushed& each : pushed) {
    const double most = speeds[each.body->mechanism];
    const double share = most > fastest ? fastest / most : 1.0;
    each.body->pushed = share * most;
    const Vec3 velocity = each.body->velocity() + share * each.velocity;
    const Vec3 spin = each.body->spin() + share * each.spin;
    if (!velocity.allFinite() || !spin.allFinite()) continue;
    ode::set_pose(each.body->ode.get(),
                  {each.start->position + h * velocity, turned(each.start->rotation, h * spin)});
    // Its spin turns with it: the same spin about other axes of the body would have another energy.
    const Vec3 kept = turned(Quat::Identity(), h * share * each.spin) * each.body->spin();
    dBodySetAngularVel(each.body->ode.get(), kept.x(), kept.y(), kept.z());
  }
}

}  // namespace angen::physics

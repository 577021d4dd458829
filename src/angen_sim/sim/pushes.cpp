#include "sim/pushes.h"

#include <algorithm>

#include "core/lists.h"
#include "sim/instance.h"

namespace angen::sim {

void Pushes::add(const LiveModel& model, std::uint32_t link, const Vec3& force, const Vec3& torque,
                 const PushTime& time) {
  pushes_.push_back({&model, false, link, force, torque, 0.0, time.start, time.duration, 0});
}

void Pushes::add(const LiveModel& model, std::uint32_t joint, double effort, const PushTime& time) {
  pushes_.push_back(
      {&model, true, joint, Vec3::Zero(), Vec3::Zero(), effort, time.start, time.duration, 0});
}

void Pushes::clear_link(const LiveModel& model, std::uint32_t link) {
  erase_if(pushes_,
           [&](const Push& p) { return p.model == &model && !p.on_joint && p.index == link; });
}

void Pushes::clear_joint(const LiveModel& model, std::uint32_t joint) {
  erase_if(pushes_,
           [&](const Push& p) { return p.model == &model && p.on_joint && p.index == joint; });
}

void Pushes::forget(const LiveModel& model) {
  erase_if(pushes_, [&](const Push& p) { return p.model == &model; });
}

void Pushes::apply(Engines& engines, Nanoseconds now, Nanoseconds step) {
  if (pushes_.empty()) return;
  for (Push& push : pushes_) {
    if (now < push.start) continue;
    ++push.ticks;
    const Parts& parts = push.model->parts;
    if (push.on_joint) {
      engines.physics.add_force(parts.joints.at(push.index), push.effort);
      continue;
    }
    const physics::LinkId link = parts.links.at(push.index);
    const desc::Link& described = push.model->desc->links[push.index];
    const Vec3 center = engines.physics.pose(link) * described.inertial.pose.position;
    engines.physics.wake(link);
    engines.physics.push(link, push.force, push.torque, center);
  }
  erase_if(pushes_, [&](const Push& p) {
    return p.duration >= 0 && p.ticks > 0 && p.ticks * step >= p.duration;
  });
}

Nanoseconds Pushes::next(Nanoseconds now) const {
  Nanoseconds first = kForever;
  for (const Push& push : pushes_) first = std::min(first, std::max(now, push.start));
  return first;
}

}  // namespace angen::sim

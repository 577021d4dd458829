#include "sim/entities.h"

#include <algorithm>

#include "core/named.h"
#include "core/nearest.h"
#include "core/text.h"
#include "sim/building.h"

namespace angen::sim {

namespace {

struct Parted {
  LiveModel* model;
  std::string rest;  // after "model::"
};

// A model's name has no "::".
Parted part(const Building& building, const std::string& name) {
  const std::size_t split = name.find("::");
  const std::string model = name.substr(0, split);
  LiveModel* live = building.find(model);
  if (live == nullptr) {
    throw Error("no model named '" + printable(model) + "'; " +
                did_you_mean(model, building.model_names()));
  }
  return {live, split == std::string::npos ? "" : name.substr(split + 2)};
}

template <class T>
Error none_of(const Parted& parted, const char* what, const std::vector<T>& all) {
  return Error("model '" + parted.model->desc->name + "' has no " + what + " '" +
               printable(parted.rest) + "'; " + did_you_mean(parted.rest, names_in(all)));
}

std::optional<Entity> find_collision(const Parted& parted) {
  const std::vector<desc::Link>& links = parted.model->desc->links;
  const std::size_t split = parted.rest.rfind("::");
  if (split == std::string::npos) return std::nullopt;
  const auto link = index_in(links, parted.rest.substr(0, split));
  if (!link) return std::nullopt;
  const auto collision = index_in(links[*link].collisions, parted.rest.substr(split + 2));
  if (!collision) return std::nullopt;
  return Entity{parted.model, *link, links[*link].collisions[*collision].pose, false};
}

}  // namespace

Entity find_link(const Building& building, const std::string& name) {
  const Parted parted = part(building, name);
  const std::vector<desc::Link>& links = parted.model->desc->links;
  if (const auto link = index_in(links, parted.rest)) return {parted.model, *link, {}, false};
  throw none_of(parted, "link", links);
}

Entity find_entity(const Building& building, const std::string& name) {
  const Parted parted = part(building, name);
  if (parted.rest.empty()) {
    const Pose frame = parted.model->desc->links.front().pose.inverse();
    return {parted.model, 0, frame, true};
  }
  if (const auto found = find_collision(parted)) return *found;
  return find_link(building, name);
}

FoundJoint find_joint(const Building& building, const std::string& name) {
  const Parted parted = part(building, name);
  const std::vector<desc::Joint>& joints = parted.model->desc->joints;
  if (const auto joint = index_in(joints, parted.rest)) return {parted.model, *joint};
  throw none_of(parted, "joint", joints);
}

Motion motion_of(const Building& building, const Entity& entity) {
  const physics::LinkState link =
      building.engines().physics.link(entity.model->parts.links.at(entity.link));
  Motion motion;
  motion.pose = link.pose * entity.in_link;
  motion.angular = link.angular_velocity;
  motion.linear =
      link.linear_velocity + link.angular_velocity.cross(motion.pose.position - link.pose.position);
  return motion;
}

Motion motion_of(const Building& building, const std::string& name) {
  return name.empty() ? Motion{} : motion_of(building, find_entity(building, name));
}

Observed observe(const Building& building, const Observation& observation) {
  Observed observed;
  for (const std::string& name : observation.entities) {
    observed.entities.push_back(motion_of(building, name));
  }
  for (const std::string& name : observation.joints) {
    const FoundJoint found = find_joint(building, name);
    observed.joints.push_back(
        building.engines().physics.joint(found.model->parts.joints.at(found.joint)));
  }
  return observed;
}

}  // namespace angen::sim

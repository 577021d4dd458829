#include "gazebo/names.h"

#include <algorithm>
#include <optional>

#include "core/named.h"
#include "core/nearest.h"
#include "core/text.h"
#include "gazebo/server.h"
#include "ros/convert.h"

namespace angen::node::gazebo {

namespace {

constexpr const char* kScope = "::";

NotFound not_found(const std::string& text, const char* what, const std::string& name,
                   const std::vector<std::string>& known) {
  return {text, "no " + std::string(what) + " named '" + printable(name) + "'; " +
                    did_you_mean(name, known)};
}

// By its full name, else the first whose name without the model's is this.
template <class Entry>
std::optional<std::uint32_t> find_scoped(const sim::SharedArray<Entry>& entries,
                                         const std::string& name) {
  std::optional<std::uint32_t> alone;
  for (std::uint32_t i = 0; i < entries.size(); ++i) {
    const std::string& full = entries[i].name;
    if (full == name) return i;
    const std::size_t split = full.find(kScope);
    if (!alone && split != std::string::npos && full.substr(split + 2) == name) alone = i;
  }
  return name.empty() ? std::nullopt : alone;
}

// model::link::collision, or a collision's name alone.
std::optional<std::string> collision_named(const sim::Structure& structure,
                                           const std::string& name) {
  for (const sim::LinkEntry& link : structure.links) {
    for (const desc::Collision& collision : structure.described(link).collisions) {
      const std::string full = link.name + kScope + collision.name;
      if (full == name || collision.name == name) return full;
    }
  }
  return std::nullopt;
}

std::optional<std::uint32_t> find_light(const sim::Structure& structure, const std::string& name) {
  if (const auto found = find_scoped(structure.lights, name)) return found;
  for (std::uint32_t i = 0; i < structure.lights.size(); ++i) {
    const sim::LightEntry& light = structure.lights[i];
    if (light.link == UINT32_MAX) continue;
    if (structure.links[light.link].name + kScope + light.light.name == name) return i;
  }
  return std::nullopt;
}

}  // namespace

std::uint32_t model_named(const sim::Structure& structure, const std::string& name,
                          const std::string& missing) {
  if (const auto index = index_in(structure.models, name)) return *index;
  throw not_found(missing, "model", name, names_in(structure.models));
}

const sim::LinkEntry& link_named(const sim::Structure& structure, const std::string& name,
                                 const std::string& missing) {
  if (const auto found = find_scoped(structure.links, name)) return structure.links[*found];
  throw not_found(missing, "link", name, names_in(structure.links));
}

const sim::JointEntry& joint_named(const sim::Structure& structure, const std::string& name,
                                   const std::string& missing) {
  if (const auto found = find_scoped(structure.joints, name)) return structure.joints[*found];
  throw not_found(missing, "joint", name, names_in(structure.joints));
}

bool has_light(const sim::Structure& structure, const std::string& name) {
  return index_in(structure.lights, name).has_value();
}

const sim::LightEntry& light_named(const sim::Structure& structure, const std::string& name) {
  if (const auto found = find_light(structure, name)) return structure.lights[*found];
  throw not_found("Requested light " + printable(name) + " not found!", "light", name,
                  names_in(structure.lights));
}

std::string frame_named(const sim::Structure& structure, const std::string& name,
                        const std::string& missing) {
  if (index_in(structure.models, name)) return name;
  if (const auto link = find_scoped(structure.links, name)) return structure.links[*link].name;
  if (const auto collision = collision_named(structure, name)) return *collision;
  if (name.empty() || name == "world" || name == "map" || name == "/map") return "";
  std::vector<std::string> known = names_in(structure.links);
  for (const std::string& model : names_in(structure.models)) known.push_back(model);
  throw not_found(missing, "frame", name, known);
}

Pose pose_of(const geometry_msgs::Pose& message) {
  Pose pose = to_pose(message);
  const bool empty = pose.rotation.coeffs().isZero(0.0);
  pose.rotation.coeffs() =
      empty ? Quat::Identity().coeffs() : pose.rotation.coeffs().stableNormalized();
  return pose;
}

std::shared_ptr<const sim::Structure> structure_of(Inbox& inbox) {
  return inbox.simulation().snapshot()->structure;
}

std::string carry_out(Inbox& inbox, sim::Action action) {
  const sim::Outcome outcome = inbox.call(std::move(action));
  if (!outcome.ok) throw Error(outcome.message);
  return outcome.message;
}

sim::Observed observe(Inbox& inbox, sim::Observation what) {
  const auto observed = std::make_shared<sim::Observed>();
  carry_out(inbox, sim::Observe{std::move(what), observed});
  return *observed;
}

sim::Motion relative(const sim::Motion& motion, const sim::Motion& frame) {
  const Quat back = frame.pose.rotation.conjugate();
  return {frame.pose.inverse() * motion.pose, back * (motion.linear - frame.linear),
          back * (motion.angular - frame.angular)};
}

}  // namespace angen::node::gazebo

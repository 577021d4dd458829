#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Vector3.h>
#include <ros/duration.h>
#include <ros/time.h>

#include <memory>
#include <string>

#include "ros/inbox.h"
#include "sim/edit.h"
#include "sim/snapshot.h"

/// Names and numbers of requests, as gazebo_ros reads them. An unknown name is thrown as
/// NotFound with the text `missing`.
namespace angen::node::gazebo {

/// The model's number in the structure.
std::uint32_t model_named(const sim::Structure& structure, const std::string& name,
                          const std::string& missing = "model does not exist");
/// model::link, or the first link of that name alone.
const sim::LinkEntry& link_named(const sim::Structure& structure, const std::string& name,
                                 const std::string& missing);
const sim::JointEntry& joint_named(const sim::Structure& structure, const std::string& name,
                                   const std::string& missing);
/// Its name, model::light, model::link::light, or a model's light alone.
const sim::LightEntry& light_named(const sim::Structure& structure, const std::string& name);
/// By its full name.
bool has_light(const sim::Structure& structure, const std::string& name);

/// The full name of a model, link or collision that a frame names; "" for "", world, map and /map.
std::string frame_named(const sim::Structure& structure, const std::string& name,
                        const std::string& missing);

/// Throws Error for a number that is not finite. A quaternion of any length is normalized; 0 is no
/// rotation.
Pose pose_of(const geometry_msgs::Pose& message);
inline Vec3 vector_of(const geometry_msgs::Vector3& v) { return {v.x, v.y, v.z}; }
inline Vec3 vector_of(const geometry_msgs::Point& v) { return {v.x, v.y, v.z}; }

std::shared_ptr<const sim::Structure> structure_of(Inbox& inbox);
/// Posts the action and waits; throws Error if it is rejected. Returns its message.
std::string carry_out(Inbox& inbox, sim::Action action);
inline void edit(Inbox& inbox, sim::Edit edit) { carry_out(inbox, std::move(edit)); }
/// To be called by the world's thread, between ticks.
sim::Observed observe(Inbox& inbox, sim::Observation what);
/// Its velocity in the frame's axes, relative to the frame.
sim::Motion relative(const sim::Motion& motion, const sim::Motion& frame);

/// A negative duration has no end.
inline sim::PushTime push_time(const ros::Time& start, const ros::Duration& duration) {
  return {static_cast<Nanoseconds>(start.toNSec()),
          duration < ros::Duration(0) ? -1 : static_cast<Nanoseconds>(duration.toNSec())};
}

}  // namespace angen::node::gazebo

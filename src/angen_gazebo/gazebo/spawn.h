#pragma once

#include <mutex>

#include "gazebo/lights.h"
#include "gazebo/server.h"
#include "plugin/library.h"
#include "ros/inbox.h"
#include "ros/topics.h"
#include "sdf/load.h"

namespace angen::node::gazebo {

/// spawn_urdf_model, spawn_sdf_model.
class Spawner {
 public:
  Spawner(Server& server, const load::SearchPaths& paths, Topics topics, Lights& lights);

 private:
  sim::Action action_of(const std::string& xml, const std::string& name, const Pose& pose);

  Inbox& inbox_;
  const load::SearchPaths& paths_;
  Topics topics_;
  Lights& lights_;
  std::mutex mutex_;  // guards the next
  Catalog catalog_;   // to know the kinds of new sensors by
};

}  // namespace angen::node::gazebo

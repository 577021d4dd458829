#pragma once

#include <ros/node_handle.h>

#include <atomic>
#include <memory>
#include <string>

#include "ros/changes.h"
#include "ros/inbox.h"
#include "ros/pacer.h"
#include "ros/topics.h"

namespace angen::node {

/// Services and topics of the node that a library adds, which is loaded by its name.
class Extension {
 public:
  virtual ~Extension() = default;

  /// The thread that ticks calls all of these.
  virtual void on_structure(const sim::Structure& structure, const Changes& changes) = 0;
  virtual void publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now) = 0;
  /// After each tick, but not in a replay: may queue actions for the next one.
  virtual void control(const sim::Snapshot& snapshot) = 0;
  /// Whether no tick may be leapt over.
  virtual bool needs_ticks() const = 0;
};

/// Parts of the node, which an extension may keep, and its settings.
struct ExtensionParts {
  sim::Simulation& simulation;
  Inbox& inbox;
  std::atomic<double>& rate;  // simulated seconds per wall second, which a service may set
  ros::NodeHandle topics;
  ros::NodeHandle services;  // served by the threads of services
  std::string models;        // a folder that model:// is searched in, besides the usual ones
  Topics per;
  double states_rate;  // Hz
};

using MakeExtension = std::unique_ptr<Extension> (*)(const ExtensionParts& parts);

/// A static object of this type, in a library, registers its extension.
struct ExtensionRegistration {
  explicit ExtensionRegistration(MakeExtension make);
};

/// The extension of a library on the plug-in path. Null, with a warning, if there is none.
std::unique_ptr<Extension> make_extension(const std::string& library, const ExtensionParts& parts);

}  // namespace angen::node

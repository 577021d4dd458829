#include "node/services.h"

#include <ros/console.h>
#include <ros/names.h>
#include <ros/service_manager.h>

#include <cmath>
#include <exception>

#include "core/diagnostics.h"
#include "core/names.h"
#include "core/text.h"
#include "node/listing.h"
#include "node/text.h"
#include "plugin/summary.h"
#include "record/world_file.h"
#include "ros/client_watch.h"
#include "ros/convert.h"

namespace angen::node {
namespace {

constexpr char kStep[] = "angen/step";
constexpr std::uint32_t kServiceThreads = 8;
constexpr std::size_t kMaxSteps = 4;             // calls that wait at once
constexpr std::uint32_t kMaxTicks = 10'000'000;  // limit of a call
constexpr std::size_t kLongestAnswer = 10'000;   // bytes

/// Counts one more while it lives.
class Count {
 public:
  explicit Count(std::atomic<std::size_t>& counter) : counter_(counter), now_(++counter) {}
  ~Count() { --counter_; }
  Count(const Count&) = delete;
  Count& operator=(const Count&) = delete;

  std::size_t now() const { return now_; }

 private:
  std::atomic<std::size_t>& counter_;
  std::size_t now_;
};

// A quaternion of zeros means no rotation.
Pose to_pose(const geometry_msgs::Pose& message) {
  Pose pose;
  pose.position = {message.position.x, message.position.y, message.position.z};
  const geometry_msgs::Quaternion& q = message.orientation;
  pose.rotation = Quat(q.w, q.x, q.y, q.z);
  if (!pose.finite()) throw Error("the pose contains a number that is not finite");
  const double norm = pose.rotation.norm();
  if (norm == 0.0) {
    pose.rotation = Quat::Identity();
  } else if (std::abs(norm - 1.0) > 0.01) {
    throw Error("the pose's quaternion has length " + std::to_string(norm) + ", must have 1");
  } else {
    pose.rotation.normalize();
  }
  return pose;
}

/// The summary of a device, NAME or KIND/NAME; empty if there is no state of one alone.
std::string state_of(const sim::Snapshot& snapshot, const std::string& target) {
  const sim::SharedArray<sim::DeviceEntry>& devices = snapshot.structure->devices;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const bool named =
        devices[i].name == target || devices[i].kind + "/" + devices[i].name == target;
    if (named && snapshot.devices[i] != nullptr) {
      return summary(devices[i].plugin->kind(), *snapshot.devices[i]);
    }
  }
  return "";
}

// Runs `work`; its exception becomes the answer.
template <class Response, class Work>
bool answered(Response& response, Work&& work) {
  try {
    const sim::Outcome outcome = work();
    response.success = outcome.ok;
    response.message = outcome.message;
  } catch (const std::exception& problem) {
    response.success = false;
    response.message = problem.what();
  }
  response.message = shortened(response.message, kLongestAnswer);
  return true;
}

}  // namespace

Services::Services(Inbox& inbox, const Events& events, const std::string& models, Topics topics)
    : inbox_(inbox),
      events_(events),
      paths_(load::SearchPaths::from_environment(models)),
      topics_(topics),
      threads_(queue_, kServiceThreads) {
  // roscpp's own deletes the loggers on Debian 12, so that the next log line ends the node.
  ros::ServiceManager::instance()->unadvertiseService(ros::names::resolve("~get_loggers"));
  node_.setCallbackQueue(&queue_);
  const auto serve_empty = [&](const std::string& name, const sim::Action& action) {
    const boost::function<bool(Empty::Request&, Empty::Response&)> called =
        [this, action](Empty::Request&, Empty::Response&) { return empty(action); };
    servers_.push_back(node_.advertiseService(name, called));
  };
  serve_empty("gazebo/pause_physics", sim::Pause{true});
  serve_empty("gazebo/unpause_physics", sim::Pause{false});
  serve_empty("gazebo/reset_simulation", sim::Reset{true});
  serve_empty("gazebo/reset_world", sim::Reset{false});
  servers_.push_back(node_.advertiseService(kStep, &Services::step, this));
  servers_.push_back(node_.advertiseService("angen/spawn", &Services::spawn, this));
  servers_.push_back(node_.advertiseService("angen/delete", &Services::erase, this));
  servers_.push_back(node_.advertiseService("angen/command", &Services::command, this));
  servers_.push_back(node_.advertiseService(kListService, &Services::list, this));
  servers_.push_back(node_.advertiseService("angen/save", &Services::save, this));
}

// An Empty service has no message: false is all that it can say.
bool Services::empty(sim::Action action) {
  try {
    const sim::Outcome outcome = inbox_.call(std::move(action));
    if (!outcome.ok) ROS_ERROR("%s", outcome.message.c_str());
    return outcome.ok;
  } catch (const std::exception& problem) {
    ROS_ERROR("%s", problem.what());
    return false;
  }
}

sim::Outcome Services::take(std::uint32_t ticks, const ros::M_string& client) {
  if (ticks == 0) return inbox_.call(sim::Step{0});
  if (ticks > kMaxTicks) {
    return {false, "a call takes at most " + std::to_string(kMaxTicks) + " ticks"};
  }
  const Count waiting(steps_);
  if (waiting.now() > kMaxSteps) {
    return {false, std::to_string(kMaxSteps) + " other steps wait; try again"};
  }
  ClientWatch watch(ros::names::resolve(kStep), client);
  return inbox_.call(sim::Step{ticks}, [&] { return watch.lost(); });
}

bool Services::step(StepCall& call) {
  angen_msgs::Step::Response& response = call.getResponse();
  return answered(response, [&] {
    // Counted before the step is queued: a later command may take effect later.
    response.commands = inbox_.posted();
    sim::Outcome outcome = take(call.getRequest().ticks, call.getConnectionHeader());
    response.taken = static_cast<std::uint32_t>(outcome.ticks);
    response.events = events_.count();
    response.sim_time = to_ros(inbox_.simulation().snapshot()->time);
    return outcome;
  });
}

void Services::check(const std::vector<NewSensor>& sensors) {
  const std::lock_guard<std::mutex> lock(catalog_mutex_);
  check_topics(sensors, catalog_, topics_);
}

sim::Action Services::spawn_action(const angen_msgs::Spawn::Request& request) {
  check_name(request.name);
  if (trimmed(request.xml).empty()) throw Error("nothing to spawn: xml is empty");
  if (!valid_utf8(request.xml)) throw Error("xml is not UTF-8");
  const Pose pose = to_pose(request.pose);
  const bool lone_sensor = load::is_sensor(request.xml);
  if (lone_sensor && request.on.empty()) {
    throw Error("a lone <sensor> needs a link: give `on` as MODEL::LINK");
  }
  if (!lone_sensor && !request.on.empty()) {
    throw Error("only a <sensor> can be put on a link, and xml contains none");
  }
  if (!valid_utf8(request.on)) throw Error("`on` is not UTF-8");
  if (lone_sensor) {
    sim::Attach attach{load::sensor(request.xml, request.name, pose), request.on};
    check({{request.name, &attach.sensor}});
    return attach;
  }
  sim::Spawn spawn{load::model(request.xml, request.name, pose, paths_)};
  check(new_sensors(spawn.model));
  return spawn;
}

bool Services::spawn(angen_msgs::Spawn::Request& request, angen_msgs::Spawn::Response& response) {
  return answered(response, [&] { return inbox_.call(spawn_action(request)); });
}

bool Services::erase(angen_msgs::Delete::Request& request, angen_msgs::Delete::Response& response) {
  return answered(response, [&] {
    check_name(request.name);
    return inbox_.call(sim::Delete{request.name});
  });
}

bool Services::command(angen_msgs::SendCommand::Request& request,
                       angen_msgs::SendCommand::Response& response) {
  return answered(response, [&] {
    const sim::Action action = any_action(request.target, request.text);
    const auto* command = std::get_if<sim::ToDevice>(&action);
    sim::Outcome outcome = inbox_.call(action);
    if (outcome.ok && command != nullptr) {
      response.state = state_of(*inbox_.simulation().snapshot(), command->name);
    }
    return outcome;
  });
}

bool Services::list(angen_msgs::List::Request& request, angen_msgs::List::Response& response) {
  try {
    const auto snapshot = inbox_.simulation().snapshot();
    response.entities =
        entities(*snapshot, inbox_.simulation().world().plugins, topics_, request.kind);
  } catch (const std::exception& problem) {
    ROS_ERROR("/angen/list: %s", problem.what());
    return false;
  }
  return true;
}

bool Services::save(angen_msgs::Save::Request&, angen_msgs::Save::Response& response) {
  return answered(response, [&] {
    const auto state = std::make_shared<sim::SavedState>();
    sim::Outcome outcome = inbox_.call(sim::Save{state});
    if (outcome.ok) response.xml = record::world_file(inbox_.simulation().world(), *state);
    return outcome;
  });
}

}  // namespace angen::node

#include "node/services.h"

#include <angen_msgs/Entity.h>
#include <ros/connection.h>
#include <ros/console.h>
#include <ros/names.h>
#include <ros/service_client_link.h>
#include <ros/service_manager.h>
#include <ros/service_publication.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <tuple>

#include "core/diagnostics.h"
#include "core/names.h"
#include "core/text.h"
#include "node/text.h"
#include "plugin/summary.h"
#include "record/world_file.h"
#include "ros/convert.h"
#include "ros/ros_kind.h"
#include "ros/wire.h"

namespace angen::node {
namespace {

constexpr char kStep[] = "angen/step";
constexpr std::uint32_t kServiceThreads = 8;
constexpr std::size_t kMaxSteps = 4;             // calls that wait at once
constexpr std::uint32_t kMaxTicks = 10'000'000;  // limit of a call
constexpr std::size_t kLongestAnswer = 10'000;   // bytes

constexpr std::chrono::milliseconds kClientPeriod(500);

// roscpp drops the connection of a client that has ended, but does not report it: its list of open
// ones is private. An explicit instantiation may name private members.
template <auto Links, auto Mutex>
struct OpenLinks {
  friend ros::V_ServiceClientLink& links_of(ros::ServicePublication& service) {
    return service.*Links;
  }
  friend boost::mutex& mutex_of(ros::ServicePublication& service) { return service.*Mutex; }
};
ros::V_ServiceClientLink& links_of(ros::ServicePublication& service);
boost::mutex& mutex_of(ros::ServicePublication& service);
template struct OpenLinks<&ros::ServicePublication::client_links_,
                          &ros::ServicePublication::client_links_mutex_>;

/// Whether the client of a call of a service is still connected.
class ClientWatch {
 public:
  /// `header`: the connection's, as ros::ServiceEvent has it; it tells connections apart.
  ClientWatch(std::string service, const ros::M_string& header)
      : service_(std::move(service)), header_(&header) {}

  /// Checks twice a second, however often it is called.
  bool lost() {
    const Clock::time_point now = Clock::now();
    if (now - checked_ < kClientPeriod) return false;
    checked_ = now;
    const auto service = ros::ServiceManager::instance()->lookupServicePublication(service_);
    if (!service) return false;
    const boost::mutex::scoped_lock lock(mutex_of(*service));
    const ros::V_ServiceClientLink& links = links_of(*service);
    return std::none_of(links.begin(), links.end(), [&](const auto& link) {
      return link->getConnection()->getHeader().getValues().get() == header_;
    });
  }

 private:
  using Clock = std::chrono::steady_clock;

  std::string service_;
  const ros::M_string* header_;
  Clock::time_point checked_ = Clock::now();
};

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

/// Models, devices and sensors, ordered by name, then kind; of one kind unless `kind` is empty.
std::vector<angen_msgs::Entity> entities(const sim::Snapshot& snapshot,
                                         const std::vector<desc::Plugin>& world_plugins,
                                         Topics topics, const std::string& kind) {
  const sim::Structure& structure = *snapshot.structure;
  std::vector<angen_msgs::Entity> all;
  const auto add = [&](const std::string& name, const std::string& its_kind, std::uint32_t model,
                       const Pose& pose) -> angen_msgs::Entity* {
    if (!kind.empty() && kind != its_kind) return nullptr;
    angen_msgs::Entity entity;
    entity.name = name;
    entity.kind = its_kind;
    if (model != UINT32_MAX) entity.model = structure.models[model]->name;
    entity.pose = to_ros(pose);
    entity.room = structure.home->get().room_name_at(pose.position);
    all.push_back(std::move(entity));
    return &all.back();
  };
  const auto place = [&](std::uint32_t model) {
    const std::uint32_t first = structure.first_link(model);
    const Pose in_model = structure.models[model]->links.front().pose;
    return snapshot.link_poses[first] * in_model.inverse();
  };
  for (std::uint32_t m = 0; m < structure.models.size(); ++m) {
    add(structure.models[m]->name, "model", m, place(m));
  }
  for (const sim::DeviceEntry& device : structure.devices) {
    const bool of_light = device.light != UINT32_MAX;
    angen_msgs::Entity* entity =
        add(device.name, device.kind, device.model,
            of_light ? structure.lights[device.light].light.pose : place(device.model));
    const RosKind& its = ros_kind(device);
    if (entity == nullptr || its.is_robot) continue;
    const Format& format = its.formats.front();
    const bool together = is_on_topic_of_kind(topics, format, nullptr);
    entity->topic = together ? kind_topic(device.kind) : topic_of(device.kind, device.name);
    entity->type = together ? format.array_type : format.type;
  }
  const std::vector<Robot> robots = find_robots(structure, world_plugins);
  for (const Robot& robot : robots) {
    const sim::DeviceEntry& device = structure.devices[robot.device];
    for (angen_msgs::Entity& entity : all) {
      if (entity.kind != device.kind || entity.name != robot.name) continue;
      entity.topic = robot.odometry_topics.front();
      entity.type = ros_kind(device).formats.front().type;
    }
  }
  for (const sim::SensorEntry& sensor : structure.sensors) {
    angen_msgs::Entity* entity =
        add(sensor.name, sensor.kind, sensor.model, snapshot.link_poses[sensor.link] * sensor.pose);
    if (entity == nullptr) continue;
    const Format& format = ros_kind(sensor).formats.front();
    const Robot* robot = robot_in(robots, sensor.model);
    const bool together = is_on_topic_of_kind(topics, format, robot);
    entity->topic = together ? kind_topic(sensor.kind)
                             : ros::names::resolve(sensor_topics(sensor, format, robot).front());
    entity->type = together ? format.array_type : format.type;
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return std::tie(a.name, a.kind) < std::tie(b.name, b.kind);
  });
  return all;
}

// A quaternion of zeros means no rotation.
Pose pose_in(const geometry_msgs::Pose& message) {
  Pose pose = to_pose(message);
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
    const bool named = devices[i].name == target || sim::full_name(devices[i]) == target;
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
  const Pose pose = pose_in(request.pose);
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

// A system plug-in of gzserver: counts the readings of its sensors and executes the bench's orders
// on stdin; it ends when stdin is closed.
//
//   rate HZ            steps a second of wall time, 0: as fast as possible
//   drive MODEL L R    the wheels left_wheel_joint and right_wheel_joint turn at L and R rad/s
//   spawn NAME FILE    puts the model of an SDF file into the world
//   delete NAME        takes a model out
//
// It writes lines to stdout: WHAT, seconds of CLOCK_MONOTONIC, and
//   probe first TIME                            the first step has begun
//   probe sample TIME SIM_TIME READINGS SENSORS four times a second
//   probe reading TIME                          the sensor of the spawned model has read
//   probe gone TIME                             the model is deleted
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/sensors/sensors.hh>
#include <gazebo/transport/transport.hh>
#include <iostream>
#include <memory>
#include <mutex>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace {

constexpr double kWheelTorque = 1.0;  // N m, as the robot's plug-in has it
constexpr std::chrono::milliseconds kPollPeriod{1};
constexpr double kSamplePeriod = 0.25;  // s

double now() {
  const auto time = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(time).count();
}

void report(const std::string& line) {
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  std::cout << "probe " << line << std::endl;
}

std::string with_time(const std::string& word, double time) {
  char text[80];
  std::snprintf(text, sizeof text, "%s %.6f", word.c_str(), time);
  return text;
}

class Probe : public gazebo::SystemPlugin {
 public:
  void Load(int, char**) override {
    created_ = gazebo::event::Events::ConnectWorldCreated(
        [this](const std::string& name) { start(gazebo::physics::get_world(name)); });
  }

 private:
  void start(const gazebo::physics::WorldPtr& world) {
    world_ = world;
    node_ = gazebo::transport::NodePtr(new gazebo::transport::Node());
    node_->Init(world->Name());
    began_ = gazebo::event::Events::ConnectWorldUpdateBegin(
        [this](const gazebo::common::UpdateInfo&) { step(); });
    std::thread([this] { listen(); }).detach();
    std::thread([this] { watch(); }).detach();
  }

  // In the world's own thread.
  void step() {
    if (!stepped_.exchange(true)) report(with_time("first", now()));
    std::vector<std::string> orders;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      orders.swap(orders_);
    }
    for (const std::string& order : orders) drain(order);
    if (!going_.empty() && !world_->ModelByName(going_)) {
      report(with_time("gone", now()));
      going_.clear();
    }
  }

  void drain(const std::string& order) {
    std::istringstream words(order);
    std::string verb, name, file;
    words >> verb;
    if (verb == "rate") {
      double hertz = 0.0;
      words >> hertz;
      world_->Physics()->SetRealTimeUpdateRate(hertz);
    } else if (verb == "drive") {
      double left = 0.0, right = 0.0;
      words >> name >> left >> right;
      turn(name + "::left_wheel_joint", left);
      turn(name + "::right_wheel_joint", right);
    } else if (verb == "spawn") {
      words >> name >> file;
      std::ifstream stream(file);
      world_->InsertModelString(std::string(std::istreambuf_iterator<char>(stream), {}));
    } else if (verb == "delete") {
      words >> going_;
      gazebo::transport::requestNoReply(node_, "entity_delete", going_);
    }
  }

  void turn(const std::string& scoped, double speed) {
    const auto split = scoped.find("::");
    const auto model = world_->ModelByName(scoped.substr(0, split));
    const auto joint = model ? model->GetJoint(scoped.substr(split + 2)) : nullptr;
    if (!joint) return;
    joint->SetParam("fmax", 0, kWheelTorque);
    joint->SetParam("vel", 0, speed);
  }

  void listen() {
    std::string line;
    while (std::getline(std::cin, line)) {
      std::istringstream words(line);
      std::string verb, name;
      words >> verb >> name;
      const std::lock_guard<std::mutex> lock(mutex_);
      if (verb == "spawn") coming_ = name;
      orders_.push_back(line);
    }
    std::_Exit(0);  // the bench has ended
  }

  // Counts every sensor from the moment it is there. A thread of its own, so that steps go
  // undisturbed.
  void watch() {
    double next = now();
    while (true) {
      std::this_thread::sleep_for(kPollPeriod);
      const double time = now();
      const bool sample = time >= next;
      std::string coming;
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        coming = coming_;
      }
      if (sample || !coming.empty()) meet_sensors(coming);
      if (!sample) continue;
      next = time + kSamplePeriod;
      std::ostringstream line;
      line << with_time("sample", time) << ' ' << world_->SimTime().Double() << ' ' << readings_
           << ' ' << known_.size();
      report(line.str());
    }
  }

  // `coming` is the model whose sensor's first reading is to be reported, or empty.
  void meet_sensors(const std::string& coming) {
    for (const auto& sensor : gazebo::sensors::SensorManager::Instance()->GetSensors()) {
      if (!known_.insert(sensor->Id()).second) continue;
      const bool awaited = !coming.empty() && sensor->ParentName().find(coming + "::") == 0;
      auto waits = std::make_shared<std::atomic<bool>>(awaited);
      if (awaited) {
        const std::lock_guard<std::mutex> lock(mutex_);
        coming_.clear();
      }
      updates_.push_back(sensor->ConnectUpdated([this, waits] {
        ++readings_;
        if (waits->exchange(false)) report(with_time("reading", now()));
      }));
    }
  }

  gazebo::physics::WorldPtr world_;
  gazebo::transport::NodePtr node_;
  gazebo::event::ConnectionPtr created_, began_;
  std::vector<gazebo::event::ConnectionPtr> updates_;
  std::set<std::uint32_t> known_;  // ids of sensors
  std::atomic<bool> stepped_{false};
  std::atomic<long> readings_{0};
  std::string going_;  // the model that is being deleted
  std::mutex mutex_;   // of the members below
  std::vector<std::string> orders_;
  std::string coming_;  // the model whose sensor is awaited
};

}  // namespace

GZ_REGISTER_SYSTEM_PLUGIN(Probe)

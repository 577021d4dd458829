#include "gazebo/physics.h"

#include <dynamic_reconfigure/ConfigDescription.h>
#include <ros/console.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/limits.h"
#include "core/text.h"
#include "gazebo/names.h"
#include "ros/convert.h"

namespace angen::node::gazebo {

namespace {

constexpr std::uint32_t kMaxIterations = 1'000'000;

// Steps a wall second to simulated seconds a wall second; 0 and less are unlimited.
double rate_of(double update_rate, double step) {
  const std::string problem = limit_problem(limits::kRate, update_rate);
  if (!problem.empty()) {
    throw Error("max_update_rate is " + number_text(update_rate) + "; " + problem);
  }
  if (update_rate > 0.0 && update_rate < 1.0) {
    throw Error("max_update_rate is " + number_text(update_rate) +
                " Hz; calls wait for the next tick: give at least 1, or 0 for no limit");
  }
  return std::max(0.0, update_rate * step);
}

bool is_other_step(double requested, double step) {
  return requested != 0.0 && std::abs(requested - step) > 1e-9 * step;
}

}  // namespace

PhysicsProperties::PhysicsProperties(Server& server, std::atomic<double>& rate)
    : inbox_(server.inbox()), rate_(rate) {
  server.serve<gazebo_msgs::GetPhysicsProperties>("GetPhysicsProperties",
                                                  [this](const auto&, auto& response) {
                                                    response = get();
                                                    return "GetPhysicsProperties: got properties";
                                                  });
  server.serve<gazebo_msgs::SetPhysicsProperties>(
      "SetPhysicsProperties",
      [this](const auto& request, auto&) { return "physics engine updated" + set(request); });
}

gazebo_msgs::GetPhysicsProperties::Response PhysicsProperties::get() {
  const auto snapshot = inbox_.simulation().snapshot();
  const desc::Physics& physics = snapshot->structure->physics;
  gazebo_msgs::GetPhysicsProperties::Response response;
  response.time_step = to_seconds(snapshot->step);
  response.pause = static_cast<unsigned char>(snapshot->paused);
  response.max_update_rate = rate_ / response.time_step;
  response.gravity = to_vector(snapshot->structure->gravity);
  gazebo_msgs::ODEPhysics& ode = response.ode_config;
  ode.sor_pgs_iters = static_cast<std::uint32_t>(physics.iterations);
  ode.contact_surface_layer = physics.contact_surface_layer;
  ode.contact_max_correcting_vel = physics.contact_max_correcting_vel;
  ode.cfm = physics.cfm;
  ode.erp = physics.erp;
  const std::lock_guard<std::mutex> lock(mutex_);
  ode.auto_disable_bodies = static_cast<unsigned char>(unused_.auto_disable_bodies);
  ode.sor_pgs_precon_iters = unused_.precon_iters;
  ode.sor_pgs_w = unused_.w;
  ode.sor_pgs_rms_error_tol = unused_.rms_error_tol;
  ode.max_contacts = unused_.max_contacts;
  return response;
}

std::string PhysicsProperties::set(const gazebo_msgs::SetPhysicsProperties::Request& request) {
  const auto snapshot = inbox_.simulation().snapshot();
  const gazebo_msgs::ODEPhysics& ode = request.ode_config;
  const double step = to_seconds(snapshot->step);
  if (!(request.time_step >= 0.0 && request.time_step <= 1.0)) {
    throw Error("time_step is " + number_text(request.time_step) + " s; it must be 0 to 1");
  }
  const double rate = rate_of(request.max_update_rate, step);
  if (!std::isfinite(ode.sor_pgs_w) || !std::isfinite(ode.sor_pgs_rms_error_tol)) {
    throw Error("sor_pgs_w and sor_pgs_rms_error_tol must be finite");
  }
  sim::SetPhysics to{snapshot->structure->physics, vector_of(request.gravity)};
  to.physics.iterations = static_cast<int>(std::clamp(ode.sor_pgs_iters, 1U, kMaxIterations));
  to.physics.contact_surface_layer = ode.contact_surface_layer;
  to.physics.contact_max_correcting_vel = ode.contact_max_correcting_vel;
  to.physics.cfm = ode.cfm;
  to.physics.erp = ode.erp;
  edit(inbox_, to);
  rate_ = rate;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    unused_ = {ode.auto_disable_bodies != 0, ode.sor_pgs_precon_iters, ode.sor_pgs_w,
               ode.sor_pgs_rms_error_tol, ode.max_contacts};
  }
  if (changed_) changed_();
  // Clients that set gravity alone leave it at 0.
  if (!is_other_step(request.time_step, step)) return "";
  return "; time_step stays the " + number_text(step) + " s of the world's <max_step_size>";
}

namespace {

using dynamic_reconfigure::Config;

using Request = gazebo_msgs::SetPhysicsProperties::Request;

// Reads or writes a member; `set` is null to read.
template <class T>
double access(T& member, const double* set) {
  if (set != nullptr) member = static_cast<T>(*set);
  return static_cast<double>(member);
}

template <auto member>
double of_request(Request& request, const double* set) {
  return access(request.*member, set);
}

template <auto member>
double of_gravity(Request& request, const double* set) {
  return access(request.gravity.*member, set);
}

template <auto member>
double of_ode(Request& request, const double* set) {
  return access(request.ode_config.*member, set);
}

struct Parameter {
  const char* name;
  const char* type;  // "double", "int", "bool"
  const char* description;
  double low;
  double high;
  double (*access)(Request& request, const double* set);
};

// Names, types and ranges are those of gazebo_ros.
constexpr Parameter kParameters[] = {
    {"time_step", "double", "Step, s; fixed while the world runs", 0, 10,
     &of_request<&Request::time_step>},
    {"max_update_rate", "double", "Steps per wall second; 0: no limit", -1, 1000,
     &of_request<&Request::max_update_rate>},
    {"gravity_x", "double", "Gravity along x, m/s^2", -100, 100,
     &of_gravity<&geometry_msgs::Vector3::x>},
    {"gravity_y", "double", "Gravity along y, m/s^2", -100, 100,
     &of_gravity<&geometry_msgs::Vector3::y>},
    {"gravity_z", "double", "Gravity along z, m/s^2", -100, 100,
     &of_gravity<&geometry_msgs::Vector3::z>},
    {"auto_disable_bodies", "bool", "Kept only: bodies at rest always fall asleep", 0, 1,
     &of_ode<&gazebo_msgs::ODEPhysics::auto_disable_bodies>},
    {"sor_pgs_precon_iters", "int", "Kept only", 0, 10000,
     &of_ode<&gazebo_msgs::ODEPhysics::sor_pgs_precon_iters>},
    {"sor_pgs_iters", "int", "Iterations of the solver that repeats failed steps", 0, 10000,
     &of_ode<&gazebo_msgs::ODEPhysics::sor_pgs_iters>},
    {"sor_pgs_w", "double", "Kept only", 0, 5, &of_ode<&gazebo_msgs::ODEPhysics::sor_pgs_w>},
    {"sor_pgs_rms_error_tol", "double", "Kept only", -1, 10000,
     &of_ode<&gazebo_msgs::ODEPhysics::sor_pgs_rms_error_tol>},
    {"cfm", "double", "Constraint force mixing of contacts and joints", 0, 10,
     &of_ode<&gazebo_msgs::ODEPhysics::cfm>},
    {"erp", "double", "Error reduction of contacts", 0, 10, &of_ode<&gazebo_msgs::ODEPhysics::erp>},
    {"contact_surface_layer", "double", "Depth that is left to contacts, m", 0, 10,
     &of_ode<&gazebo_msgs::ODEPhysics::contact_surface_layer>},
    {"contact_max_correcting_vel", "double", "Speed at which contacts part, m/s", 0, 10000000,
     &of_ode<&gazebo_msgs::ODEPhysics::contact_max_correcting_vel>},
    {"max_contacts", "int", "Kept only", 0, 10000000,
     &of_ode<&gazebo_msgs::ODEPhysics::max_contacts>},
};

void add(Config& config, const Parameter& parameter, double value) {
  const std::string type = parameter.type;
  if (type == "bool") {
    config.bools.emplace_back();
    config.bools.back().name = parameter.name;
    config.bools.back().value = static_cast<unsigned char>(value != 0.0);
  } else if (type == "int") {
    config.ints.emplace_back();
    config.ints.back().name = parameter.name;
    config.ints.back().value = static_cast<std::int32_t>(std::min(value, 2147483647.0));
  } else {
    config.doubles.emplace_back();
    config.doubles.back().name = parameter.name;
    config.doubles.back().value = value;
  }
}

template <class F>
Config config_of(F&& value) {
  Config config;
  for (const Parameter& parameter : kParameters) add(config, parameter, value(parameter));
  dynamic_reconfigure::GroupState group;
  group.name = "Default";
  group.state = 1;
  config.groups.push_back(group);
  return config;
}

Request request_of(const gazebo_msgs::GetPhysicsProperties::Response& now) {
  Request request;
  request.time_step = now.time_step;
  request.max_update_rate = now.max_update_rate;
  request.gravity = now.gravity;
  request.ode_config = now.ode_config;
  return request;
}

Config config_of_now(PhysicsProperties& physics) {
  Request now = request_of(physics.get());
  return config_of([&](const Parameter& parameter) { return parameter.access(now, nullptr); });
}

dynamic_reconfigure::ConfigDescription description_of(PhysicsProperties& physics) {
  dynamic_reconfigure::ConfigDescription description;
  dynamic_reconfigure::Group group;
  group.name = "Default";
  for (const Parameter& parameter : kParameters) {
    dynamic_reconfigure::ParamDescription one;
    one.name = parameter.name;
    one.type = parameter.type;
    one.level = 1;
    one.description = parameter.description;
    group.parameters.push_back(std::move(one));
  }
  description.groups.push_back(std::move(group));
  description.min = config_of([](const Parameter& parameter) { return parameter.low; });
  description.max = config_of([](const Parameter& parameter) { return parameter.high; });
  description.dflt = config_of_now(physics);
  return description;
}

// Throws Error for a name that is not a parameter of that type.
void set_in(Request& request, const std::string& name, const std::string& type, double value) {
  const auto* found =
      std::find_if(std::begin(kParameters), std::end(kParameters),
                   [&](const Parameter& p) { return name == p.name && type == p.type; });
  if (found == std::end(kParameters)) {
    throw Error("there is no parameter '" + printable(name) + "' of type " + type);
  }
  if (std::isnan(value)) throw Error("the parameter " + name + " is not a number");
  const double bounded = std::clamp(value, found->low, found->high);
  found->access(request, &bounded);
}

}  // namespace

Reconfigure::Reconfigure(ros::NodeHandle node, PhysicsProperties& physics) : physics_(physics) {
  descriptions_ = node.advertise<dynamic_reconfigure::ConfigDescription>(
      "gazebo/parameter_descriptions", 1, true);
  descriptions_.publish(description_of(physics));
  updates_ = node.advertise<Config>("gazebo/parameter_updates", 1, true);
  publish();
  physics.on_change([this] { publish(); });
  server_ = node.advertiseService("gazebo/set_parameters", &Reconfigure::set, this);
}

void Reconfigure::publish() {
  const std::lock_guard<std::mutex> lock(mutex_);
  updates_.publish(config_of_now(physics_));
}

// Missing parameters keep their values. The reply type has no field for an error message: roscpp
// logs exceptions, and sends its text to the client.
bool Reconfigure::set(Call::Request& request, Call::Response& response) {
  try {
    Request changed = request_of(physics_.get());
    for (const auto& p : request.config.bools)
      set_in(changed, p.name, "bool", p.value != 0 ? 1 : 0);
    for (const auto& p : request.config.ints) set_in(changed, p.name, "int", p.value);
    for (const auto& p : request.config.doubles) set_in(changed, p.name, "double", p.value);
    if (!request.config.strs.empty()) {
      throw Error("there is no parameter '" + printable(request.config.strs[0].name) + "'");
    }
    physics_.set(changed);
    response.config = config_of_now(physics_);
  } catch (const std::exception& problem) {
    throw Error("/gazebo/set_parameters: " + printable(problem.what(), 2000));
  }
  return true;
}

}  // namespace angen::node::gazebo

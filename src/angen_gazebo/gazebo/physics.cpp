#include "gazebo/physics.h"

#include <algorithm>
#include <cmath>

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

PhysicsProperties::PhysicsProperties(Server& server, Inbox& inbox, std::atomic<double>& rate)
    : inbox_(inbox), rate_(rate) {
  server.serve<gazebo_msgs::GetPhysicsProperties>("get_physics_properties", "GetPhysicsProperties",
                                                  [this](const auto&, auto& response) {
                                                    response = get();
                                                    return "GetPhysicsProperties: got properties";
                                                  });
  server.serve<gazebo_msgs::SetPhysicsProperties>(
      "set_physics_properties", "SetPhysicsProperties",
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

}  // namespace angen::node::gazebo

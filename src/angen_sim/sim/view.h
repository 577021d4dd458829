#pragma once

#include <string>
#include <vector>

#include "plugin/outputs.h"
#include "plugin/view.h"
#include "sim/building.h"
#include "sim/clock.h"
#include "sim/command.h"

namespace angen::sim {

/// The world as one device or sensor queries it at one moment.
class InstanceView : public View {
 public:
  InstanceView(Building& building, const LiveModel& live, Clock clock,
               SensorInstance* sensor = nullptr)
      : building_(building),
        engines_(building.engines()),
        live_(live),
        clock_(clock),
        sensor_(sensor) {}

  Nanoseconds time() const override { return clock_.time; }
  Nanoseconds step() const override { return clock_.step; }
  /// A change activates everything, so that it counts for no query.
  Vec3 gravity() const override { return building_.gravity(); }
  Pose pose() const override;
  JointView joint(JointRef joint) const override;
  JointWrench wrench(JointRef joint) const override;
  LinkView link(LinkRef link) const override;
  std::vector<ContactPair> contacts(ContactRef collision) const override;
  std::vector<ContactPair> contacts_within(ContactRef collision, Nanoseconds period) const override;
  using View::devices;
  std::vector<DeviceView> devices(const std::string& field,
                                  const Eigen::AlignedBox3d& within) const override;
  std::optional<DeviceView> device(const std::string& field, const std::string& kind,
                                   const std::string& name) const override;
  bool has_device(const std::string& field, const std::string& kind,
                  const std::string& name) const override;
  const Home& home() const override;
  const rays::Scene& rays() const override;
  std::vector<std::uint32_t> own_shapes() const override;
  std::string model_of(std::uint32_t shape) const override;
  light::Sample illuminance(light::Probe& probe, const Pose& pose) const override;
  double ambient_temperature() const override { return engines_.ambient_temperature; }
  const std::vector<rays::WarmShape>& warm_shapes() const override;
  Revisions watch(const std::function<std::vector<rays::Ray>()>& make) const override;
  std::vector<std::uint8_t> colors(const render::PinholeCamera& lens,
                                   const Pose& pose) const override;
  std::vector<float> depths(const render::PinholeCamera& lens, const Pose& pose) const override;

  const Queried& queried() const { return queried_; }

 private:
  void note_query(const std::string& field, const Heights& heights) const;
  bool watches() const { return sensor_ != nullptr && sensor_->near != nullptr; }

  Building& building_;
  Engines& engines_;
  const LiveModel& live_;
  Clock clock_;
  SensorInstance* sensor_;
  mutable Queried queried_;
};

/// The effects of one device on the world.
class InstanceOutputs : public Outputs {
 public:
  InstanceOutputs(Building& building, LiveModel& live, const DeviceInstance& device,
                  Nanoseconds time, std::vector<Event>& events, std::vector<ToDevice>& commands)
      : building_(building),
        engines_(building.engines()),
        live_(live),
        device_(device),
        time_(time),
        events_(events),
        commands_(commands) {}

  void force(JointRef joint, double force) override;
  void motor(JointRef joint, double velocity, double max_force) override;
  void latch(JointRef joint, double break_force) override;
  void unlatch(JointRef joint) override;
  void drive(LinkRef link, const Vec3& velocity, double yaw_rate, double max_force) override;
  void posture(LinkRef link, int posture, const Pose& at) override;
  void push(LinkRef link, const Vec3& force, const Vec3& torque, const Vec3& point) override;
  void light(LightRef light, double level, double luminous_flux) override;
  void temperature(SurfaceRef surface, double now, double limit, double time_constant) override;
  void command(const std::string& kind, const std::string& name, const std::string& text) override {
    commands_.push_back({kind, name, Command{text, {}, "", 0.0}});
  }
  void event(const std::string& event, const std::string& detail) override;

  bool lights_changed() const { return lights_changed_; }
  bool had_event() const { return had_event_; }

 private:
  Building& building_;
  Engines& engines_;
  LiveModel& live_;
  const DeviceInstance& device_;
  Nanoseconds time_;
  std::vector<Event>& events_;
  std::vector<ToDevice>& commands_;
  bool lights_changed_ = false;
  bool had_event_ = false;
};

}  // namespace angen::sim

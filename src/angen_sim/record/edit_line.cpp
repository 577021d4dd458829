#include "record/edit_line.h"

#include <functional>
#include <map>

#include "sdf/load.h"

namespace angen::record {

namespace {

constexpr std::uint64_t kEndless = UINT64_MAX;  // duration

std::vector<double> three(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Vec3 vector_in(const LineReader& line, const char* key) {
  const std::vector<double> v = line.numbers(key);
  if (v.size() != 3) line.fail("'" + std::string(key) + "' has not three numbers");
  return {v[0], v[1], v[2]};
}

void write_state(const sim::StateIn& state, LineWriter& line) {
  line.text("frame", state.frame).numbers("pose", numbers_of(state.pose));
  line.numbers("linear", three(state.linear)).numbers("angular", three(state.angular));
}

sim::StateIn state_in(const LineReader& line) {
  return {line.text("frame"), pose_in(line), vector_in(line, "linear"), vector_in(line, "angular")};
}

void write_time(const sim::PushTime& time, LineWriter& line) {
  line.whole("start", static_cast<std::uint64_t>(time.start));
  line.whole("duration", time.duration < 0 ? kEndless : static_cast<std::uint64_t>(time.duration));
}

sim::PushTime time_in(const LineReader& line) {
  const std::uint64_t duration = line.whole("duration");
  return {static_cast<Nanoseconds>(line.whole("start")),
          duration == kEndless ? -1 : static_cast<Nanoseconds>(duration)};
}

struct EditWriter {
  LineWriter& line;

  void operator()(const sim::SetModelState& e) const {
    line.text("do", "set_model_state").text("of", e.model);
    write_state(e.state, line);
  }
  void operator()(const sim::SetLinkState& e) const {
    line.text("do", "set_link_state").text("of", e.link);
    write_state(e.state, line);
  }
  void operator()(const sim::SetJoints& e) const {
    line.text("do", "set_joints").text("of", e.model).texts("joints", e.joints);
    line.numbers("positions", e.positions);
  }
  void operator()(const sim::PushLink& e) const {
    line.text("do", "push_link").text("of", e.link).text("frame", e.frame);
    line.numbers("point", three(e.point)).numbers("force", three(e.force));
    line.numbers("torque", three(e.torque));
    write_time(e.time, line);
  }
  void operator()(const sim::PushJoint& e) const {
    line.text("do", "push_joint").text("of", e.joint).number("effort", e.effort);
    write_time(e.time, line);
  }
  void operator()(const sim::ClearPushes& e) const {
    line.text("do", "clear_pushes").text("of", e.of);
  }
  void operator()(const sim::SetLinkProperties& e) const {
    const Eigen::Matrix3d& moment = e.inertial.moment;
    line.text("do", "set_link").text("of", e.link).number("mass", e.inertial.mass);
    line.numbers("pose", numbers_of(e.inertial.pose)).flag("gravity", e.gravity);
    line.numbers("moment", {moment.data(), moment.data() + 9});
  }
  void operator()(const sim::SetJointProperties& e) const {
    line.text("do", "set_joint").text("of", e.joint).numbers("damping", e.damping);
    line.numbers("upper", e.upper).numbers("lower", e.lower);
    if (!e.motor_force) return;
    line.number("motor_force", *e.motor_force).number("motor_velocity", e.motor_velocity);
  }
  void operator()(const sim::SetPhysics& e) const {
    const desc::Physics& p = e.physics;
    line.text("do", "set_physics").numbers("gravity", three(e.gravity));
    line.whole("iterations", static_cast<std::uint64_t>(p.iterations));
    line.number("erp", p.erp).number("cfm", p.cfm);
    line.number("max_correcting_vel", p.contact_max_correcting_vel);
    line.number("surface_layer", p.contact_surface_layer);
    line.number("real_time_factor", p.real_time_factor);
  }
  void operator()(const sim::SetLight& e) const {
    line.text("do", "set_light").text("of", e.light);
    line.numbers("diffuse", three(e.diffuse.cast<double>()));
    line.flag("cast_shadows", e.cast_shadows).numbers("direction", three(e.direction));
    line.numbers("pose", numbers_of(e.pose));
  }
  void operator()(const sim::AddLight& e) const {
    line.text("do", "add_light").text("of", e.light.name);
    line.numbers("pose", numbers_of(e.light.pose)).text("sdf", e.sdf);
  }
  void operator()(const sim::DeleteLight& e) const {
    line.text("do", "delete_light").text("of", e.light);
  }
};

sim::Edit link_in(const LineReader& line) {
  sim::SetLinkProperties edit{line.text("of"), {}, line.flag("gravity")};
  edit.inertial.mass = line.number("mass");
  edit.inertial.pose = pose_in(line);
  const std::vector<double> moment = line.numbers("moment");
  if (moment.size() != 9) line.fail("'moment' has not nine numbers");
  edit.inertial.moment = Eigen::Matrix3d::Map(moment.data());
  return edit;
}

sim::Edit joint_in(const LineReader& line) {
  sim::SetJointProperties edit{line.text("of"),       line.numbers("damping"),
                               line.numbers("upper"), line.numbers("lower"),
                               std::nullopt,          0.0};
  if (!line.has("motor_force")) return edit;
  edit.motor_force = line.number("motor_force");
  edit.motor_velocity = line.number("motor_velocity");
  return edit;
}

sim::Edit physics_in(const LineReader& line) {
  sim::SetPhysics edit;
  edit.gravity = vector_in(line, "gravity");
  edit.physics.iterations = static_cast<int>(line.whole("iterations"));
  edit.physics.erp = line.number("erp");
  edit.physics.cfm = line.number("cfm");
  edit.physics.contact_max_correcting_vel = line.number("max_correcting_vel");
  edit.physics.contact_surface_layer = line.number("surface_layer");
  edit.physics.real_time_factor = line.number("real_time_factor");
  return edit;
}

sim::Edit light_in(const LineReader& line) {
  return sim::SetLight{line.text("of"), vector_in(line, "diffuse").cast<float>(),
                       line.flag("cast_shadows"), vector_in(line, "direction"), pose_in(line)};
}

sim::Edit new_light_in(const LineReader& line) {
  const std::string sdf = line.text("sdf");
  sim::AddLight edit{load::light(sdf, line.text("of"), {}), sdf};
  edit.light.pose = pose_in(line);
  return edit;
}

}  // namespace

std::vector<double> numbers_of(const Pose& pose) {
  const Vec3& p = pose.position;
  const auto& q = pose.rotation.coeffs();
  return {p.x(), p.y(), p.z(), q[0], q[1], q[2], q[3]};
}

Pose pose_in(const LineReader& line) {
  const std::vector<double> v = line.numbers("pose");
  if (v.size() != 7) line.fail("'pose' has not seven numbers");
  Pose pose;
  pose.position = {v[0], v[1], v[2]};
  pose.rotation = Quat(v[6], v[3], v[4], v[5]);
  return pose;
}

void write_edit(const sim::Edit& edit, LineWriter& line) { std::visit(EditWriter{line}, edit); }

std::optional<sim::Edit> edit_in(const std::string& what, const LineReader& line) {
  using Read = std::function<sim::Edit(const LineReader&)>;
  static const std::map<std::string, Read> known = {
      {"set_model_state",
       [](const LineReader& l) {
         return sim::SetModelState{l.text("of"), state_in(l)};
       }},
      {"set_link_state",
       [](const LineReader& l) {
         return sim::SetLinkState{l.text("of"), state_in(l)};
       }},
      {"set_joints",
       [](const LineReader& l) {
         return sim::SetJoints{l.text("of"), l.texts("joints"), l.numbers("positions")};
       }},
      {"push_link",
       [](const LineReader& l) {
         return sim::PushLink{l.text("of"),          l.text("frame"),        vector_in(l, "point"),
                              vector_in(l, "force"), vector_in(l, "torque"), time_in(l)};
       }},
      {"push_joint",
       [](const LineReader& l) {
         return sim::PushJoint{l.text("of"), l.number("effort"), time_in(l)};
       }},
      {"clear_pushes", [](const LineReader& l) { return sim::ClearPushes{l.text("of")}; }},
      {"set_link", link_in},
      {"set_joint", joint_in},
      {"set_physics", physics_in},
      {"set_light", light_in},
      {"add_light", new_light_in},
      {"delete_light", [](const LineReader& l) { return sim::DeleteLight{l.text("of")}; }},
  };
  const auto read = known.find(what);
  if (read == known.end()) return std::nullopt;
  return read->second(line);
}

}  // namespace angen::record

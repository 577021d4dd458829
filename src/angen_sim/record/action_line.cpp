#include "record/action_line.h"

#include <tuple>
#include <type_traits>
#include <utility>

#include "sdf/load.h"

namespace angen::record {

namespace {

/// The type of a line that holds a T: the greatest whole number is -1.
template <class T>
using Held =
    std::conditional_t<std::is_integral_v<T> && !std::is_same_v<T, bool>, std::uint64_t, T>;

/// Writes values into a line; Reads, below, reads the same keys.
class Writes {
 public:
  explicit Writes(LineWriter& line) : line_(line) {}

  template <class T>
  Writes& operator()(const char* key, const T& value) {
    put(key, value);
    return *this;
  }
  void read_light(const sim::AddLight&) const {}

 private:
  template <class T>
  void put(const char* key, const T& value) {
    line_.add(key, static_cast<Held<T>>(value));
  }
  void put(const char* key, const std::vector<LogFile>& files) {
    std::vector<std::string> flat;
    for (const LogFile& file : files) flat.insert(flat.end(), {file.uri, file.hash});
    put(key, flat);
  }
  template <int kRows, int kColumns>
  void put(const char* key, const Eigen::Matrix<double, kRows, kColumns>& matrix) {
    put(key, std::vector<double>(matrix.data(), matrix.data() + matrix.size()));
  }
  void put(const char* key, const Eigen::Vector3f& vector) {
    put(key, Vec3(vector.cast<double>()));
  }
  void put(const char* key, const Pose& pose) {
    Eigen::Matrix<double, 7, 1> numbers;
    numbers << pose.position, pose.rotation.coeffs();
    put(key, numbers);
  }
  void put(const char* key, const std::optional<double>& number) {
    if (number) put(key, *number);
  }

  LineWriter& line_;
};

class Reads {
 public:
  explicit Reads(const LineReader& line) : line_(line) {}

  template <class T>
  Reads& operator()(const char* key, T& value) {
    get(key, value);
    return *this;
  }
  /// Reads it from its text, whose pose is rounded.
  static void read_light(sim::AddLight& edit) {
    const Pose pose = edit.light.pose;
    edit.light = load::light(edit.sdf, edit.light.name, {});
    edit.light.pose = pose;
  }

 private:
  template <class T>
  void get(const char* key, T& value) {
    value = static_cast<T>(line_.get<Held<T>>(key));
  }
  void get(const char* key, std::vector<LogFile>& files) {
    const auto flat = line_.get<std::vector<std::string>>(key);
    if (flat.size() % 2 != 0) line_.fail("'files' is not pairs of address and hash");
    for (std::size_t i = 0; i < flat.size(); i += 2) files.push_back({flat[i], flat[i + 1]});
  }
  template <int kRows, int kColumns>
  void get(const char* key, Eigen::Matrix<double, kRows, kColumns>& matrix) {
    const auto numbers = line_.get<std::vector<double>>(key);
    if (numbers.size() != static_cast<std::size_t>(matrix.size())) {
      line_.fail("'" + std::string(key) + "' has not " + std::to_string(matrix.size()) +
                 " numbers");
    }
    matrix = Eigen::Matrix<double, kRows, kColumns>::Map(numbers.data());
  }
  void get(const char* key, Eigen::Vector3f& vector) {
    Vec3 numbers;
    get(key, numbers);
    vector = numbers.cast<float>();
  }
  void get(const char* key, Pose& pose) {
    Eigen::Matrix<double, 7, 1> numbers;
    get(key, numbers);
    pose.position = numbers.head<3>();
    pose.rotation.coeffs() = numbers.tail<4>();
  }
  void get(const char* key, std::optional<double>& number) {
    if (line_.has(key)) get(key, number.emplace());
  }

  const LineReader& line_;
};

constexpr auto kHeader = [](auto& line, auto& header) {
  line("version", header.version)("host", header.host)("seed", header.seed)("step", header.step);
  line("world", header.world)("models", header.models)("files", header.files)("sdf", header.sdf);
};

/// The "do" of a line, and its keys and values, by a Writes or Reads.
template <class T, class Describe>
struct Entry {
  using Content = T;
  const char* name;
  Describe describe;
};
template <class T, class Describe>
constexpr Entry<T, Describe> entry(const char* name, Describe describe) {
  return {name, describe};
}

constexpr auto kState = [](auto& line, auto& state) {
  line("frame", state.frame)("pose", state.pose);
  line("linear", state.linear)("angular", state.angular);
};
constexpr auto kTime = [](auto& line, auto& time) {
  line("start", time.start)("duration", time.duration);
};

constexpr std::tuple kEntries{
    entry<sim::ToDevice>("command",
                         [](auto& line, auto& a) {
                           line("kind", a.kind)("name", a.name)("text", a.command.text);
                           line("values", a.command.values)("verb", a.command.verb);
                           line("number", a.command.number);
                         }),
    entry<SpawnText>("spawn",
                     [](auto& line, auto& a) {
                       line("name", a.name)("pose", a.pose)("files", a.files)("sdf", a.sdf);
                     }),
    entry<AttachText>("attach",
                      [](auto& line, auto& a) {
                        line("name", a.name)("on", a.link)("pose", a.pose)("sdf", a.sdf);
                      }),
    entry<sim::Delete>("delete", [](auto& line, auto& a) { line("name", a.name); }),
    entry<sim::Pause>("pause", [](auto& line, auto& a) { line("paused", a.paused); }),
    entry<sim::Step>("step", [](auto& line, auto& a) { line("ticks", a.ticks); }),
    entry<sim::StopStep>("stop_step", [](auto& line, auto& a) { line("which", a.which); }),
    entry<sim::Reset>("reset", [](auto& line, auto& a) { line("with_time", a.with_time); }),
    entry<sim::Reject>(
        "reject",
        [](auto& line, auto& a) { line("source", a.source)("kind", a.kind)("reason", a.reason); }),
    entry<sim::Note>("note",
                     [](auto& line, auto& a) {
                       line("source", a.source)("kind", a.kind)("event", a.event);
                       line("detail", a.detail);
                     }),
    entry<ReadingRequest>(
        "request",
        [](auto& line, auto& a) { line("kind", a.kind)("name", a.name)("wanted", a.wanted); }),
    entry<Check>("fingerprint", [](auto& line, auto& a) { line("hash", a.fingerprint); }),
    entry<sim::SetModelState>("set_model_state",
                              [](auto& line, auto& a) { kState(line("of", a.model), a.state); }),
    entry<sim::SetLinkState>("set_link_state",
                             [](auto& line, auto& a) { kState(line("of", a.link), a.state); }),
    entry<sim::SetJoints>("set_joints",
                          [](auto& line, auto& a) {
                            line("of", a.model)("joints", a.joints)("positions", a.positions);
                          }),
    entry<sim::PushLink>("push_link",
                         [](auto& line, auto& a) {
                           line("of", a.link)("frame", a.frame)("point", a.point);
                           kTime(line("force", a.force)("torque", a.torque), a.time);
                         }),
    entry<sim::PushJoint>(
        "push_joint",
        [](auto& line, auto& a) { kTime(line("of", a.joint)("effort", a.effort), a.time); }),
    entry<sim::ClearPushes>("clear_pushes", [](auto& line, auto& a) { line("of", a.of); }),
    entry<sim::SetLinkProperties>("set_link",
                                  [](auto& line, auto& a) {
                                    line("of", a.link)("mass", a.inertial.mass);
                                    line("pose", a.inertial.pose)("gravity", a.gravity);
                                    line("moment", a.inertial.moment);
                                  }),
    entry<sim::SetJointProperties>("set_joint",
                                   [](auto& line, auto& a) {
                                     line("of", a.joint)("damping", a.damping)("upper", a.upper);
                                     line("lower", a.lower)("motor_force", a.motor_force);
                                     if (a.motor_force) line("motor_velocity", a.motor_velocity);
                                   }),
    entry<sim::SetPhysics>("set_physics",
                           [](auto& line, auto& a) {
                             auto& p = a.physics;
                             line("gravity", a.gravity)("iterations", p.iterations);
                             line("erp", p.erp)("cfm", p.cfm);
                             line("max_correcting_vel", p.contact_max_correcting_vel);
                             line("surface_layer", p.contact_surface_layer);
                             line("real_time_factor", p.real_time_factor);
                           }),
    entry<sim::SetLight>("set_light",
                         [](auto& line, auto& a) {
                           line("of", a.light)("diffuse", a.diffuse)("pose", a.pose);
                           line("cast_shadows", a.cast_shadows)("direction", a.direction);
                         }),
    entry<sim::AddLight>("add_light",
                         [](auto& line, auto& a) {
                           line("of", a.light.name)("pose", a.light.pose)("sdf", a.sdf);
                           line.read_light(a);
                         }),
    entry<sim::DeleteLight>("delete_light", [](auto& line, auto& a) { line("of", a.light); }),
};

template <class T, std::size_t I = 0>
constexpr const auto& entry_of() {
  using Each = std::tuple_element_t<I, std::decay_t<decltype(kEntries)>>;
  if constexpr (std::is_same_v<typename Each::Content, T>) {
    return std::get<I>(kEntries);
  } else {
    return entry_of<T, I + 1>();
  }
}

template <class T>
void write(const T& content, LineWriter& line) {
  line.add("do", entry_of<T>().name);
  Writes writes(line);
  entry_of<T>().describe(writes, content);
}

struct WriteAction {
  LineWriter& line;

  void operator()(const sim::Edit& edit) const { std::visit(*this, edit); }
  template <class T>
  void operator()(const T& action) const {
    write(action, line);
  }
  // Such actions are SpawnText, AttachText, or in no log.
  void operator()(const sim::Spawn&) const {}
  void operator()(const sim::Attach&) const {}
  void operator()(const sim::Save&) const {}
  void operator()(const sim::Observe&) const {}
};

template <class T>
LogContent content_of(T content) {
  if constexpr (std::is_constructible_v<sim::Edit, T>) {
    return sim::Action(sim::Edit(std::move(content)));
  } else if constexpr (std::is_constructible_v<sim::Action, T>) {
    return sim::Action(std::move(content));
  } else {
    return content;
  }
}

/// Whether the line's "do" is that of the entry; it is read then.
template <class Entry>
bool read_as(const Entry& entry, const std::string& what, const LineReader& line,
             LogContent& content) {
  if (what != entry.name) return false;
  typename Entry::Content read{};
  Reads reads(line);
  entry.describe(reads, read);
  content = content_of(std::move(read));
  return true;
}

}  // namespace

void write_content(const LogContent& content, LineWriter& line) {
  std::visit(
      [&](const auto& each) {
        if constexpr (std::is_same_v<std::decay_t<decltype(each)>, sim::Action>) {
          std::visit(WriteAction{line}, each);
        } else {
          write(each, line);
        }
      },
      content);
}

LogContent read_content(const LineReader& line) {
  const auto what = line.get<std::string>("do");
  LogContent content;
  const bool known = std::apply(
      [&](const auto&... each) { return (read_as(each, what, line, content) || ...); }, kEntries);
  if (!known) line.fail("'" + what + "' is not an action of a log");
  return content;
}

void write_header(const LogHeader& header, LineWriter& line) {
  Writes writes(line);
  kHeader(writes, header);
}

LogHeader read_header(const LineReader& line) {
  LogHeader header;
  Reads reads(line);
  kHeader(reads, header);
  return header;
}

}  // namespace angen::record

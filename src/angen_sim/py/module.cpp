// `import angen`: the simulator without ROS. SI units, radians, NumPy arrays.
#include <pybind11/eval.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <optional>
#include <tuple>

#include "core/named.h"
#include "core/names.h"
#include "core/plugin_path.h"
#include "plugin/json.h"
#include "py/bindings.h"
#include "py/world.h"

namespace angen::py {

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor>;
using Text = std::string;
using Entity = std::tuple<Text, Text, Text, Eigen::Matrix<double, 1, 7>>;

// The catalog of worlds whose models may name libraries anywhere, or on the plug-in path only.
std::shared_ptr<Catalog> catalog(bool any_path) {
  static const auto bound = std::make_shared<Catalog>(false);
  static const auto free = std::make_shared<Catalog>(true);
  return any_path ? free : bound;
}

template <class Entries>
std::vector<std::string> names_of_kind(const Entries& entries, const std::string& kind) {
  std::vector<std::string> all;
  for (const auto& entry : entries) {
    if (kind.empty() || entry.kind == kind) all.push_back(entry.name);
  }
  return all;
}

Rows link_poses(const World& world) {
  const auto& poses = world.now().link_poses;
  Rows rows(static_cast<Eigen::Index>(poses.size()), 7);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    rows.row(static_cast<Eigen::Index>(i)) = to_row(poses[i]);
  }
  return rows;
}

Eigen::VectorXd joint_positions(const World& world) {
  const auto& positions = world.now().joint_positions;
  Eigen::VectorXd all(static_cast<Eigen::Index>(positions.size()));
  for (std::size_t i = 0; i < positions.size(); ++i)
    all[static_cast<Eigen::Index>(i)] = positions[i];
  return all;
}

// The pose of its model's first link, or its light.
Pose place_of(const sim::Snapshot& snapshot, const sim::DeviceEntry& device) {
  if (device.light != UINT32_MAX) return snapshot.structure->lights[device.light].light.pose;
  return snapshot.link_poses[snapshot.structure->first_link(device.model)];
}

std::vector<Entity> entities(const World& world, const std::string& kind) {
  const sim::Snapshot& now = world.now();
  std::vector<Entity> all;
  const auto add = [&](const auto& entry, const Pose& pose) {
    const std::string model =
        entry.model == UINT32_MAX ? "" : now.structure->models[entry.model]->name;
    all.emplace_back(entry.kind, entry.name, model, to_row(pose));
  };
  for (const sim::DeviceEntry& device : now.structure->devices) {
    if (kind.empty() || device.kind == kind) add(device, place_of(now, device));
  }
  for (const sim::SensorEntry& sensor : now.structure->sensors) {
    if (kind.empty() || sensor.kind == kind) add(sensor, now.link_poses[sensor.link] * sensor.pose);
  }
  return all;
}

// In slices, so that a signal ends a long run; until `take` returns true.
template <class F>
void advance(const World& world, std::uint64_t ticks, F&& take) {
  constexpr std::uint64_t kSlice = 10000;
  const Exclusive::Busy busy(world);
  bool stops = false;
  while (ticks > 0 && !stops) {
    const std::uint64_t slice = std::min(ticks, kSlice);
    {
      const Interrupts interrupts;
      const pyb::gil_scoped_release release;
      stops = take(slice, interrupts);
    }
    ticks -= slice;
    if (PyErr_CheckSignals() != 0) throw pyb::error_already_set();
  }
}

template <class T>
pyb::array_t<T> to_array(const std::vector<T>& values) {
  return pyb::array_t<T>(static_cast<pyb::ssize_t>(values.size()), values.data());
}

pyb::dict take_readings(World& world) {
  const ReadingLog::Rows rows = world.readings().take();
  pyb::dict texts, columns;
  for (const auto& [row, text] : rows.texts) texts[pyb::int_(row)] = text;
  columns["time"] = to_array(rows.time);
  columns["series"] = to_array(rows.series);
  columns["value"] = to_array(rows.value);
  columns["texts"] = texts;
  return columns;
}

void bind_world(pyb::module_& module) {
  pyb::class_<World> world(module, "World", "A world that advances by step() and run().");
  bind_edits(world);
  bind_geometry(world);
  bind_grid(module, world);
  world
      .def(pyb::init([](const std::string& path, std::uint64_t seed, const std::string& record,
                        bool anywhere, std::optional<double> memory_limit) {
             if (memory_limit) load::set_memory_limit(*memory_limit);
             return std::make_unique<World>(path, seed, catalog(anywhere || allow_paths()), record,
                                            anywhere);
           }),
           pyb::arg("path"), pyb::arg("seed") = 0, pyb::arg("record") = "",
           pyb::arg("allow_paths") = false, pyb::arg("memory_limit") = pyb::none(),
           "Loads a world file (SDF); `record` is a file for the log that Replay reads. With "
           "allow_paths, models may name files and plug-in libraries anywhere. One that would take "
           "more than `memory_limit` MB is rejected; see set_memory_limit.")
      .def_static(
          "from_text",
          [](const std::string& text, std::uint64_t seed, bool anywhere,
             std::optional<double> memory_limit) {
            if (memory_limit) load::set_memory_limit(*memory_limit);
            return std::make_unique<World>(text, "<text>", seed, catalog(anywhere || allow_paths()),
                                           anywhere);
          },
          pyb::arg("text"), pyb::arg("seed") = 0, pyb::arg("allow_paths") = false,
          pyb::arg("memory_limit") = pyb::none(), "Loads a world from SDF text.")
      .def(
          "step",
          [](World& w, std::uint64_t ticks) {
            advance(w, ticks, [&](std::uint64_t n, const Interrupts& interrupts) {
              return w.step(n, interrupts);
            });
          },
          pyb::arg("ticks") = 1, "Advances by ticks, each of them taken.")
      .def(
          "run",
          [](World& w, double seconds, bool long_steps, bool until_event) {
            advance(w, w.ticks_in(seconds), [&](std::uint64_t n, const Interrupts& interrupts) {
              return w.run(n, long_steps, until_event, interrupts);
            });
          },
          pyb::arg("seconds"), pyb::arg("long_steps") = false, pyb::arg("until_event") = false,
          "Advances by simulated seconds; ticks in which nothing happens are leapt over. With "
          "long_steps ticks are up to 20 ms long while nothing moves but people and leaves free of "
          "contact. With until_event it ends earlier: with the tick of the first event.")
      .def("command", &World::command, pyb::arg("kind"), pyb::arg("name"), pyb::arg("text") = "",
           pyb::arg("values") = std::vector<double>{},
           "Commands a device, e.g. ('door', 'bathroom1', 'Open'); ('drive', 'turtlebot', "
           "values=[0.3, 0.0]) in m/s and rad/s.")
      .def("spawn", &World::spawn, pyb::arg("what"), pyb::arg("name") = "",
           pyb::arg("pose") = std::vector<double>(6, 0.0), pyb::arg("on") = "",
           "Adds a model (SDF text, path or model:// uri), or a <sensor> to the link `on`; pose is "
           "x y z roll pitch yaw (m, rad).")
      .def("delete", &World::remove, pyb::arg("name"), "Deletes a model or a sensor.")
      .def("request", &World::request, pyb::arg("kind"), pyb::arg("name"),
           pyb::arg("wanted") = true,
           "Sensors that sample on demand (lidar, camera, depth) do so while they are requested.")
      .def("close", &World::close, "Ends its record; it can be read, and advances no more.")
      .def(
          "__enter__", [](World& w) -> World& { return w; }, pyb::return_value_policy::reference)
      .def(
          "__exit__", [](World& w, const pyb::args&) { w.close(); }, "Calls close().")
      .def("__repr__", &World::text)
      .def("reset", &World::reset, "Everything back to its start, the time to 0.")
      .def("save", &World::save, "The present world as SDF text.")
      .def(
          "sensor",
          [](const World& w, const std::string& kind, const std::string& name) {
            return to_dict(w.sensor(kind, name));
          },
          pyb::arg("kind"), pyb::arg("name"), "The latest reading of a sensor, as a dict.")
      .def(
          "device",
          [](const World& w, const std::string& kind, const std::string& name) {
            return to_dict(w.device(kind, name));
          },
          pyb::arg("kind"), pyb::arg("name"), "The latest state of a device, as a dict.")
      .def("summary", &World::summary, pyb::arg("kind"), pyb::arg("name"),
           "A sensor's reading or a device's state in a few words, as /angen/summary shows it; '' "
           "before the first.")
      .def(
          "summaries",
          [](const World& w) {
            std::vector<std::tuple<Text, Text, Text, bool, double, std::vector<double>>> all;
            for (const World::Brief& b : w.summaries()) {
              all.emplace_back(b.kind, b.name, b.text, b.alarm, b.stamp, b.numbers);
            }
            return all;
          },
          "Each sensor and device: (kind, name, summary, alarm, stamp, values); the values (nan: "
          "missing) are of the fields that are flags or numbers.")
      .def(
          "sensors",
          [](const World& w, const std::string& kind) {
            return names_of_kind(w.now().structure->sensors, kind);
          },
          pyb::arg("kind") = "")
      .def(
          "devices",
          [](const World& w, const std::string& kind) {
            return names_of_kind(w.now().structure->devices, kind);
          },
          pyb::arg("kind") = "")
      .def(
          "entities", &entities, pyb::arg("kind") = "",
          "Devices and sensors: (kind, name, model, pose); pose is x y z qx qy qz qw in the world, "
          "of a sensor, or of the first link of a device's model.")
      .def_property_readonly(
          "time", [](const World& w) { return to_seconds(w.now().time); }, "s")
      .def_property_readonly("tick", [](const World& w) { return w.now().tick; })
      .def_property_readonly("models",
                             [](const World& w) { return names_in(w.now().structure->models); })
      .def_property_readonly(
          "links", [](const World& w) { return names_in(w.now().structure->links); },
          "model::link, in the order of link_poses' rows")
      .def_property_readonly("joints",
                             [](const World& w) { return names_in(w.now().structure->joints); })
      .def_property_readonly("lights",
                             [](const World& w) { return names_in(w.now().structure->lights); })
      .def_property_readonly("link_poses", &link_poses,
                             "(links, 7): x y z qx qy qz qw, world frame")
      .def_property_readonly("joint_positions", &joint_positions, "(joints,): rad or m")
      .def_property_readonly(
          "light_levels", [](const World& w) { return *w.now().light_levels; },
          "0..1, in the order of lights")
      .def_property_readonly("awake_bodies",
                             [](const World& w) { return w.now().counts.awake_bodies; })
      .def_property_readonly("failed_steps",
                             [](const World& w) { return w.now().counts.failed_steps; })
      .def_property_readonly("readings", [](const World& w) { return w.now().counts.readings; })
      .def_property_readonly(
          "home", [](const World& w) { return home_dict(w.now().structure->home->get()); },
          "The home: its storeys, rooms, things, doors and elevators, as a dict; docs/home.md.")
      .def_property_readonly(
          "revision", [](const World& w) { return w.now().structure->revision; },
          "of its parts: another one after each spawn and deletion")
      .def_property_readonly(
          "scene", [](const World& w) { return scene_dict(w.now()); },
          "What viewers draw, as a dict: links with their groups and poses, shapes, meshes, lights "
          "and the fields of sensors, as angen_msgs/Scene has them.")
      .def(
          "room_at",
          [](const World& w, double x, double y, double z) {
            return w.now().structure->home->get().room_name_at(Vec3(x, y, z));
          },
          pyb::arg("x"), pyb::arg("y"), pyb::arg("z"),
          "The name of the room that a place is in, or in whose wall, floor or ceiling; '' "
          "outside.")
      .def(
          "home_findings",
          [](const World& w) {
            std::vector<std::pair<Text, Text>> all;
            for (const HomeFinding& finding : w.now().structure->home->findings()) {
              all.emplace_back(finding.guessed ? "guessed" : "contradicting", finding.text);
            }
            return all;
          },
          "Missing and wrong parts in the description of the home: ('guessed' or 'contradicting', "
          "what).")
      .def_property_readonly("fingerprint", &World::fingerprint,
                             "a hash of every snapshot since the start or the last reset")
      .def_property_readonly("warnings", &World::warnings,
                             "warnings about the loaded files: 'file:line: text'")
      .def_property_readonly(
          "ignored", &World::ignored,
          "unread elements of the loaded files: 'file:line: <element> in <parent>'")
      .def(
          "events",
          [](World& w) {
            std::vector<std::tuple<double, Text, Text, Text, Text>> all;
            for (const sim::Event& e : w.take_events()) {
              all.emplace_back(to_seconds(e.stamp), e.source, e.kind, e.event, e.detail);
            }
            return all;
          },
          "What happened since the last call: (time, source, kind, event, detail).")
      .def("keep_readings", &World::keep_readings,
           "Keeps all that sensors publish from now on, for take_readings().")
      .def("take_readings", &take_readings,
           "The readings since the last call, as columns: time (s), series, value, and texts: "
           "{row: text}. `series` has numbers of rows in reading_series. Lists and images are left "
           "out.")
      .def_property_readonly(
          "reading_series",
          [](World& w) {
            std::vector<std::tuple<Text, Text, Text, Text, Text>> all;
            for (const ReadingLog::Series& s : w.readings().series()) {
              all.emplace_back(s.kind, s.name, s.field, s.unit, s.type);
            }
            return all;
          },
          "Of the readings that are kept: (kind, name, field, unit, type).");
}

// Pure-Python bases with answers that do nothing, to be overridden.
void bind_bases(pyb::module_& module) {
  pyb::exec(R"(
class Sensor:
    """A sensor in Python. Override configure(params, wiring), aim(view) -> (n, 8) rows of origin,
    direction, min, max (m, world frame) or None, and read(view, ranges, rng) -> dict. After read(),
    idle_until(view) says when (s) it may next return other values, as long as its pose and all that
    it queried stay the same: math.inf without a memory, 0 for the next time. `fields`
    declares the keys of that dict, as {'range': 'number m', 'hit': 'flag'}: type and unit; types
    are flag, integer, number, text, numbers and texts. None are declared: any are taken.
    describe(kind) (static) declares them with docs and words, see Kind."""

    fields: 'dict[str, str]' = {}
    rate: float = 10.0
    sample_period: float = 0.0

    @staticmethod
    def describe(kind: Kind) -> None:
        pass

    def configure(self, params: Params, wiring: Wiring) -> None:
        pass

    def aim(self, view: View) -> 'numpy.typing.ArrayLike | None':
        return None

    def read(self, view: View, ranges: 'numpy.typing.NDArray[numpy.float64]',
             rng: Rng) -> 'dict[str, typing.Any]':
        raise NotImplementedError('a sensor has to read')

    def idle_until(self, view: View) -> float:
        return 0.0


class Device:
    """A device in Python. Override serves(model, joints, lights) -> bool (static), configure(params,
    wiring), command(text, values, view) -> None or a reason to reject, update(view, outputs) and
    report(view) -> dict, whose keys `fields` declares, as of a Sensor. describe(kind) (static)
    declares verbs too, as kind.verb('Dim', 'dims it', 'percent', '%', min=0, max=100)."""

    fields: 'dict[str, str]' = {}

    @staticmethod
    def describe(kind: Kind) -> None:
        pass

    @staticmethod
    def serves(model: str, joints: 'list[str]', lights: 'list[str]') -> bool:
        return True

    def configure(self, params: Params, wiring: Wiring) -> None:
        pass

    def command(self, text: str, values: 'list[float]', view: View) -> 'str | None':
        return 'takes no commands'

    def update(self, view: View, outputs: Outputs) -> None:
        pass

    def report(self, view: View) -> 'dict[str, typing.Any]':
        return {}
)",
            module.attr("__dict__"));
}

void bind_names(pyb::module_& module) {
  module.def(
      "check_name",
      [](const pyb::str& name) {
        check_name(name.attr("encode")().cast<std::string>());  // or a UnicodeEncodeError
        return name;
      },
      pyb::arg("name"), "The name, if a model, sensor or device can have it; else Error says why.");
}

void bind_catalog(pyb::module_& module) {
  bind_scripts(module, {catalog(false), catalog(true)});
  module.def(
      "plugins",
      [] {
        return pyb::module_::import("json").attr("loads")(
            to_json(describe(*catalog(allow_paths()))));
      },
      "Every kind of sensor and device on the plug-in path: a list of dicts with library, kind, "
      "doc, role, rate, on_demand, models, sensor_type, example, command_topic, verbs, fields and "
      "params, as `angen plugins --json` prints it.");
}

void bind_limits(pyb::module_& module) {
  module.def("memory_limit", &load::memory_limit,
             "The most memory, in MB, that a world or model may be estimated to take.");
  module.def("set_memory_limit", &load::set_memory_limit, pyb::arg("megabytes"),
             "Sets it for this process; ANGEN_MEMORY_LIMIT of the environment, or 4096, without.");
}

}  // namespace

PYBIND11_MODULE(angen, module) {
  module.doc() = "Angen: a smart apartment building with robots and people in it.";
  module.attr("__version__") = ANGEN_VERSION;
  pyb::register_exception<Error>(module, "Error", PyExc_ValueError);
  bind_plugin_types(module);
  bind_bases(module);
  bind_world(module);
  bind_replay(module, catalog);
  bind_catalog(module);
  bind_names(module);
  bind_limits(module);
  sign(module);
}

}  // namespace angen::py

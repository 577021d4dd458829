#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "core/limits.h"
#include "core/named.h"
#include "core/text.h"
#include "plugin/outputs.h"
#include "plugin/view.h"
#include "plugin/wiring.h"
#include "py/bindings.h"
#include "py/lent.h"

namespace pybind11::detail {

template <>
class type_caster<angen::Params> : public angen::py::LentCaster<angen::Params> {};
template <>
class type_caster<angen::Wiring> : public angen::py::LentCaster<angen::Wiring> {};
template <>
class type_caster<angen::View> : public angen::py::LentCaster<angen::View> {};
template <>
class type_caster<angen::Outputs> : public angen::py::LentCaster<angen::Outputs> {};
template <>
class type_caster<angen::Rng> : public angen::py::LentCaster<angen::Rng> {};
template <>
class type_caster<angen::Kind> : public angen::py::LentCaster<angen::Kind> {};

}  // namespace pybind11::detail

namespace angen::py {

namespace {

// Python objects may only be released with the GIL held, also from a thread that steps without it.
class Held {
 public:
  explicit Held(pyb::object object) : object_(std::move(object)) {}
  ~Held() {  // NOLINT(bugprone-exception-escape): without the GIL there is no way on
    if (Py_IsInitialized() == 0) {  // the catalog outlives the interpreter; there is no GIL to get
      object_.release();
      return;
    }
    const pyb::gil_scoped_acquire gil;
    object_ = pyb::object();
  }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;
  const pyb::object& get() const { return object_; }

 private:
  pyb::object object_;
};

// An exception of a Python method becomes an Error, as of any plug-in.
template <class F>
auto with_python(F&& call) {
  const pyb::gil_scoped_acquire gil;
  try {
    return call();
  } catch (pyb::error_already_set& error) {
    const std::string problem = one_line(error);  // runs Python code, in which Ctrl-C would be lost
    if (error.matches(PyExc_KeyboardInterrupt)) PyErr_SetInterrupt();
    throw Error(problem);
  }
}

// A value that a plug-in's class has; `rule` says what it must be.
template <class T>
T as(const pyb::object& value, const std::string& rule) {
  try {
    return pyb::cast<T>(value);
  } catch (const pyb::cast_error&) {
    throw Error(rule + "; it is " + printable(pyb::cast<std::string>(pyb::repr(value)), 100));
  }
}

Reading& filled(const pyb::object& values, const std::string& method, Reading& reading) {
  if (!pyb::isinstance<pyb::dict>(values)) {
    throw Error(method + "() must return a dict; it is " +
                printable(pyb::cast<std::string>(pyb::repr(values)), 100));
  }
  from_dict(values, reading);
  return reading;
}

class PythonSensor : public Sensor {
 public:
  explicit PythonSensor(pyb::object self) : self_(std::move(self)) {}

  void configure(Params& params, Wiring& wiring) override {
    with_python([&] { self_.get().attr("configure")(Lent(params).get(), Lent(wiring).get()); });
  }
  Nanoseconds sample_period() const override {
    return with_python([&] {
      const std::string rule = "sample_period must be s from 0 to 1e9";
      const auto seconds = as<double>(self_.get().attr("sample_period"), rule);
      if (!(seconds >= 0.0 && seconds <= limits::kTime.most)) {
        throw Error(rule + "; it is " + number_text(seconds));
      }
      return from_seconds(seconds);
    });
  }
  void aim(const View& view, RayBatch& batch) override {
    with_python([&] {
      const pyb::object rays = self_.get().attr("aim")(Lent(view).get());
      if (rays.is_none()) return;
      // Rows of origin x y z, direction x y z, min and max range.
      const auto rows = as<Eigen::Matrix<double, Eigen::Dynamic, 8, Eigen::RowMajor>>(
          rays, "aim() must return None or (n, 8) numbers");
      if (rows.hasNaN()) throw Error("aim() returned a row with NaN");
      for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        batch.push_back({rows.block<1, 3>(i, 0).transpose(),
                         rows.block<1, 3>(i, 3).transpose().normalized(), rows(i, 6), rows(i, 7)});
      }
    });
  }
  void read(const View& view, Hits hits, Rng& rng, Reading& reading) override {
    with_python([&] {
      Eigen::VectorXd ranges(static_cast<Eigen::Index>(hits.size()));
      for (std::size_t i = 0; i < hits.size(); ++i) {
        ranges[static_cast<Eigen::Index>(i)] = hits[i].range;
      }
      const Lent seen(view);
      filled(self_.get().attr("read")(seen.get(), ranges, Lent(rng).get()), "read", reading);
      const auto until = as<double>(self_.get().attr("idle_until")(seen.get()),
                                    "idle_until() must return a time, s");
      idle_until_ = until < 1e9 ? from_seconds(until) : kForever;
    });
  }
  Nanoseconds idle_until(const Ahead&) const override { return idle_until_; }

 private:
  Held self_;
  Nanoseconds idle_until_ = 0;
};

class PythonDevice : public Device {
 public:
  explicit PythonDevice(pyb::object self) : self_(std::move(self)) {}

  void configure(Params& params, Wiring& wiring) override {
    with_python([&] { self_.get().attr("configure")(Lent(params).get(), Lent(wiring).get()); });
  }
  Verdict command(const Command& command, const View& view) override {
    return with_python([&] {
      const pyb::object reason =
          self_.get().attr("command")(command.text, command.values, Lent(view).get());
      if (reason.is_none()) return Verdict::accept();
      return Verdict::reject(as<std::string>(reason, "command() must return None or a str"));
    });
  }
  void update(const View& view, Outputs& outputs) override {
    with_python([&] { self_.get().attr("update")(Lent(view).get(), Lent(outputs).get()); });
  }
  void report(const View& view, Reading& state) const override {
    with_python([&] { filled(self_.get().attr("report")(Lent(view).get()), "report", state); });
  }

 private:
  Held self_;
};

/// A field that a class declares, as "number m".
Field declared_field(const std::string& name, const std::string& declared) {
  if (name == "kind" || name == "stamp") {
    throw Error("a field is called '" + name + "', which each reading has; give it another name");
  }
  const std::size_t blank = std::min(declared.find(' '), declared.size());
  const std::string type = declared.substr(0, blank);
  std::vector<std::string> types;
  for (const Field::Type each : {Field::Type::kFlag, Field::Type::kInteger, Field::Type::kNumber,
                                 Field::Type::kText, Field::Type::kNumbers, Field::Type::kTexts}) {
    if (type == name_of(each)) {
      Field field;
      field.name = name;
      field.type = each;
      if (blank < declared.size()) field.unit = declared.substr(blank + 1);
      return field;
    }
    types.emplace_back(name_of(each));
  }
  throw Error("the field '" + name + "' is declared as '" + declared +
              "'; right is TYPE or TYPE UNIT, types are " + join_names(types));
}

class PythonPlugin : public Plugin {
 public:
  PythonPlugin(const std::string& kind, pyb::object type, bool is_sensor)
      : kind_(kind, ""), type_(std::move(type)), is_sensor_(is_sensor) {
    const pyb::object doc = type_.get().attr("__doc__");
    if (!doc.is_none()) kind_.doc = pyb::cast<std::string>(doc);
    if (is_sensor_) kind_.rate(as<double>(type_.get().attr("rate"), "rate must be a number, Hz"));
    const auto fields = as<std::map<std::string, std::string>>(
        type_.get().attr("fields"), "fields must be a dict such as {'range': 'number m'}");
    for (const auto& [name, declared] : fields)
      kind_.fields.push_back(declared_field(name, declared));
    type_.get().attr("describe")(Lent(kind_).get());
  }

  const Kind& kind() const override { return kind_; }
  bool serves(const ModelInfo& model) const override {
    if (is_sensor_) return false;
    return with_python([&] {
      return as<bool>(type_.get().attr("serves")(model.name, names_in(model.joints), model.lights),
                      "serves() must return True or False");
    });
  }
  std::unique_ptr<Device> make_device() const override {
    if (is_sensor_) return nullptr;
    return with_python([&] { return std::make_unique<PythonDevice>(type_.get()()); });
  }
  std::unique_ptr<Sensor> make_sensor(Params&) const override {
    if (!is_sensor_) return nullptr;
    return with_python([&] { return std::make_unique<PythonSensor>(type_.get()()); });
  }

 private:
  Kind kind_;
  Held type_;
  bool is_sensor_;
};

// A method of Kind that is about the field that was added last.
template <class... Args>
auto of_field(Kind& (Kind::*method)(Args...)) {
  return [method](Kind& kind, Args... args) -> Kind& {
    if (kind.fields.empty()) throw Error("describe(kind): the first field comes before this");
    return (kind.*method)(std::move(args)...);
  };
}

// The methods of Kind, whose calls can be chained, as in C++.
void bind_kind(pyb::module_& module) {
  const auto same = pyb::return_value_policy::reference;
  const auto name = pyb::arg("name"), unit = pyb::arg("unit"), doc = pyb::arg("doc");
  pyb::class_<Kind>(module, "Kind", "The verbs and fields of a kind, to describe.")
      .def(
          "verb",
          [](Kind& kind, std::string verb, std::string meaning, std::string argument,
             std::string its_unit, double min, double max, bool whole) -> Kind& {
            kind.verbs.push_back({std::move(verb),
                                  std::move(meaning),
                                  std::move(argument),
                                  std::move(its_unit),
                                  {min, max},
                                  whole});
            return kind;
          },
          same, name, doc, pyb::arg("argument") = "", pyb::arg("unit") = "",
          pyb::arg("min") = Range{}.min, pyb::arg("max") = Range{}.max, pyb::arg("whole") = false)
      .def("flag", &Kind::flag, same, name, doc)
      .def("integer", &Kind::integer, same, name, unit, doc)
      .def("number", &Kind::number, same, name, unit, doc)
      .def("text", &Kind::text, same, name, doc)
      .def("choice", &Kind::choice, same, name, pyb::arg("words"), doc)
      .def("numbers", &Kind::numbers, same, name, unit, doc)
      .def("texts", &Kind::texts, same, name, doc)
      .def("shown", of_field(&Kind::shown), same, pyb::arg("decimals") = 0)
      .def("shown_as", of_field(&Kind::shown_as), same, pyb::arg("yes"), pyb::arg("no"))
      .def("alarm", of_field(&Kind::alarm), same, pyb::arg("yes"), pyb::arg("no"))
      .def("events", of_field(&Kind::events), same, pyb::arg("begin"), pyb::arg("end"),
           pyb::arg("in_alarm") = true);
}

void bind_params(pyb::module_& module) {
  pyb::class_<Params>(module, "Params", "A plug-in's parameters; a wrong value raises angen.Error.")
      .def(
          "number",
          [](Params& p, const std::string& path, double fallback, const std::string& unit,
             const std::string& doc, double min, double max) {
            return p.number(path, fallback, unit, doc, {min, max});
          },
          pyb::arg("path"), pyb::arg("default"), pyb::arg("unit") = "", pyb::arg("doc") = "",
          pyb::arg("min") = Range{}.min, pyb::arg("max") = Range{}.max)
      .def(
          "noise",
          [](Params& p, const std::string& field, const std::string& unit, const std::string& doc,
             bool relative) { return p.noise(field, unit, doc, relative); },
          pyb::arg("field"), pyb::arg("unit") = "", pyb::arg("doc") = "",
          pyb::arg("relative") = false,
          "Reads <noise_stddev>, of Gaussian noise that is added to this key of read().")
      .def("flag", &Params::flag, pyb::arg("path"), pyb::arg("default"), pyb::arg("doc") = "")
      .def("text", &Params::text, pyb::arg("path"), pyb::arg("default"), pyb::arg("doc") = "");
}

template <class Ref>
void bind_handle(pyb::module_& module, const char* name) {
  const pyb::class_<Ref> bound(module, name);
}

void bind_wiring(pyb::module_& module) {
  bind_handle<JointRef>(module, "JointRef");
  bind_handle<LinkRef>(module, "LinkRef");
  bind_handle<LightRef>(module, "LightRef");
  bind_handle<SurfaceRef>(module, "SurfaceRef");
  pyb::class_<Wiring>(module, "Wiring", "Names of the model to handles; unknown names raise.")
      .def_property_readonly("name", &Wiring::name)
      .def_property_readonly("model", &Wiring::model)
      .def("has_joint", &Wiring::has_joint, pyb::arg("name"))
      .def("joint", &Wiring::joint, pyb::arg("name"))
      .def("link", &Wiring::link, pyb::arg("name"))
      .def("light", &Wiring::light, pyb::arg("name"))
      .def("surfaces", &Wiring::surfaces, pyb::arg("visual") = "",
           "Visuals of that name, or all, that a collision has its surface from.")
      .def("mass", &Wiring::mass, pyb::arg("link"), "kg, of the link and all that is fixed to it");
}

pyb::list devices(const View& view, const std::string& field) {
  pyb::list found;
  for (const DeviceView& device : view.devices(field)) {
    found.append(pyb::make_tuple(pyb::str(device.name.data(), device.name.size()),
                                 to_row(device.pose), to_dict(device.state)));
  }
  return found;
}

void bind_view(pyb::module_& module) {
  pyb::class_<View>(module, "View", "What a plug-in may see; SI units, world frame.")
      .def_property_readonly(
          "time", [](const View& v) { return to_seconds(v.time()); }, "s")
      .def_property_readonly(
          "step", [](const View& v) { return to_seconds(v.step()); }, "s")
      .def_property_readonly(
          "pose", [](const View& v) { return to_row(v.pose()); }, "x y z qx qy qz qw")
      .def_property_readonly(
          "rotation", [](const View& v) { return v.pose().rotation.toRotationMatrix(); },
          "3x3, of the pose")
      .def(
          "joint",
          [](const View& v, JointRef ref) {
            const JointView joint = v.joint(ref);
            return std::make_tuple(joint.position, joint.velocity, joint.effort);
          },
          pyb::arg("joint"), "position, velocity, effort: rad or m, N m or N")
      .def(
          "link", [](const View& v, LinkRef ref) { return to_row(v.link(ref).pose); },
          pyb::arg("link"), "x y z qx qy qz qw")
      .def("devices", devices, pyb::arg("field"),
           "name, pose of the model and state, as a dict, of each device whose state has `field`");
  pyb::class_<Outputs>(module, "Outputs", "What a device may do in one tick.")
      .def("force", &Outputs::force, pyb::arg("joint"), pyb::arg("effort"),
           "N or N m on a joint, for this tick")
      .def("motor", &Outputs::motor, pyb::arg("joint"), pyb::arg("velocity"),
           pyb::arg("max_effort"), "velocity, greatest force; until changed")
      .def("light", &Outputs::light, pyb::arg("light"), pyb::arg("level"), pyb::arg("flux"),
           "level 0..1, luminous flux in lm at level 1")
      .def("temperature", &Outputs::temperature, pyb::arg("surface"), pyb::arg("now"),
           pyb::arg("limit"), pyb::arg("time_constant") = 0.0,
           "K of a surface: from now to a limit, exponentially with a time constant in s")
      .def("event", &Outputs::event, pyb::arg("event"), pyb::arg("detail") = "");
  pyb::class_<Rng>(module, "Rng", "Random numbers of this sensor at this tick.")
      .def("uniform", &Rng::uniform)
      .def("gaussian", &Rng::gaussian);
}

}  // namespace

std::shared_ptr<const Plugin> python_sensor(const std::string& kind, pyb::object type) {
  return std::make_shared<PythonPlugin>(kind, std::move(type), true);
}

std::shared_ptr<const Plugin> python_device(const std::string& kind, pyb::object type) {
  return std::make_shared<PythonPlugin>(kind, std::move(type), false);
}

void bind_plugin_types(pyb::module_& module) {
  bind_kind(module);
  bind_params(module);
  bind_wiring(module);
  bind_view(module);
}

}  // namespace angen::py

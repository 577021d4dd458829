#include <optional>

#include "core/plugin_path.h"
#include "py/bindings.h"
#include "py/world.h"

namespace angen::py {

namespace {

// A replay with a view of its present world.
class Replay : public record::Replay, public Exclusive {
 public:
  using record::Replay::Replay;

  World& present() {
    if (!present_) present_ = std::make_unique<World>(simulation());
    return *present_;
  }
  World* shown() { return present_.get(); }
  void advance_to(Nanoseconds time) {
    const std::shared_ptr<const sim::Snapshot> made = advance(time);
    if (present_) present_->follow(made);
  }
  std::unique_ptr<World> take() {
    if (present_) throw Error("its present world is in use");
    const Busy busy(*this);
    return std::make_unique<World>(take_simulation(), log().header.models);
  }

 private:
  std::unique_ptr<World> present_;
};

// Until the end, or `seconds` further; true while something is left.
bool advance_replay(Replay& replay, double seconds) {
  const Exclusive::Busy busy(replay);
  std::optional<Exclusive::Busy> shown_busy;
  if (const World* shown = replay.shown()) shown_busy.emplace(*shown);
  const Nanoseconds end = replay.simulation().snapshot()->time + duration(seconds);
  while (!replay.done() && replay.simulation().snapshot()->time < end) {
    {
      const Interrupts interrupts;
      const pyb::gil_scoped_release release;
      replay.advance_to(end);
    }
    if (PyErr_CheckSignals() != 0) throw pyb::error_already_set();
  }
  return !replay.done();
}

double time_of_end(const record::Log& log) {
  const auto& entries = log.entries;
  return entries.empty() ? 0.0 : to_seconds(entries.back().tick * log.header.step);
}

}  // namespace

}  // namespace angen::py

namespace pybind11::detail {

template <>
class type_caster<angen::py::Replay> : public angen::py::ExclusiveCaster<angen::py::Replay> {};

}  // namespace pybind11::detail

namespace angen::py {

void bind_replay(pyb::module_& module, std::shared_ptr<Catalog> (*catalog)(bool any_path)) {
  pyb::class_<Replay>(module, "Replay", "A recorded run, run again; see docs/replay.md.")
      .def(pyb::init([catalog](const std::string& path, bool leap) {
             return std::make_unique<Replay>(record::read_log(path), catalog(allow_paths()),
                                             record::ReplaySettings{leap, true});
           }),
           pyb::arg("path"), pyb::arg("leap") = true,
           "Reads a log and builds its world. Without leap, each tick is taken.")
      .def("advance", &advance_replay, pyb::arg("seconds"),
           "Continues by simulated seconds, to the end at most; True while something is left.")
      .def("world", &Replay::take, "The current world, to continue with. The replay ends.")
      .def_property_readonly("present", &Replay::present,
                             "The world as the replay has it: a World that can be read, and that "
                             "advances with the replay.")
      .def_property_readonly(
          "time", [](Replay& r) { return to_seconds(r.simulation().snapshot()->time); }, "s")
      .def_property_readonly(
          "end", [](const Replay& r) { return time_of_end(r.log()); }, "of the log, s")
      .def_property_readonly("actions", &Replay::actions, "executed actions")
      .def_property_readonly("compared", &Replay::compared, "fingerprints that were equal")
      .def_property_readonly("mismatch", &Replay::mismatch,
                             "the first fingerprint that differed; '' where all were equal")
      .def_property_readonly(
          "truncated", [](const Replay& r) { return r.log().truncated; },
          "the missing part of the log's end; '' where it is complete")
      .def_property_readonly("seed", [](const Replay& r) { return r.log().header.seed; })
      .def_property_readonly(
          "path", [](const Replay& r) { return r.log().header.world; }, "of the world's file");
}

}  // namespace angen::py

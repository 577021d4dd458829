#include <algorithm>
#include <utility>

#include "plugin/library.h"
#include "plugin/ray_geometry.h"
#include "plugin/wiring.h"

namespace angen {

namespace {

// Answers any name, so that every plug-in can be configured on nothing.
class AnyWiring : public Wiring {
 public:
  explicit AnyWiring(std::string kind) : kind_(std::move(kind)) {}
  std::string name() const override { return kind_; }
  std::string model() const override { return "model"; }
  std::vector<Room> rooms() const override { return std::vector<Room>(1); }
  std::vector<double> floors() const override { return {0.0, 3.0}; }
  bool has_joint(const std::string&) const override { return true; }
  std::vector<std::string> joint_names() const override { return {"joint"}; }
  JointRef joint(const std::string&) override { return {0}; }
  JointLimits limits(JointRef) const override { return {-1e16, 1e16}; }
  LinkRef link(const std::string&) override { return {0}; }
  bool is_fixed(JointRef) const override { return false; }
  std::string child_of(JointRef) const override { return "link"; }
  Vec3 anchor(JointRef) const override { return Vec3::Zero(); }
  Vec3 axis(JointRef) const override { return Vec3::UnitZ(); }
  double mass(LinkRef) const override { return 1.0; }
  Vec3 center(LinkRef) const override { return Vec3::Zero(); }
  LightRef light(const std::string&) override { return {0}; }
  std::vector<std::string> collision_names(LinkRef) const override { return {"collision"}; }
  ContactRef collision(LinkRef, const std::string&) override { return {0}; }
  std::optional<SensorPart> sensor(const std::string&) override { return std::nullopt; }
  std::vector<SurfaceRef> surfaces(const std::string&) override { return {}; }

 private:
  std::string kind_;
};

ModelInfo any_model() {
  ModelInfo model;
  model.name = "MODEL";
  return model;
}

// Parameters of every sensor that the simulator itself reads.
void read_common(Params& params, const Kind& kind) {
  params.update_period();
  params.text("topicName", "/angen/" + kind.name + "/NAME", "where it publishes");
  if (!kind.ray_color().empty()) read_ray_color(params, kind);
  params.text("frameName", "NAME", "frame_id of its messages");
  params.text("fault", "", "a simulated fault, such as dropout share=0.02; see docs/data.md");
}

// The parameters that one reads when it is configured with nothing but these.
std::vector<ParamDoc> params_of(const std::string& library, const Plugin& plugin,
                                std::vector<Element> given) {
  const Element element{"plugin", "", {{"filename", library}}, std::move(given)};
  Params params(element, nullptr, plugin.kind().rate());
  AnyWiring wiring(plugin.kind().name);
  const auto sensor = plugin.make_sensor(params);
  const auto device = sensor ? nullptr : plugin.make_device();
  try {
    if (sensor) sensor->configure(params, wiring);
    if (device) {
      read_device_name(params, plugin.instance_name(any_model()));
      device->configure(params, wiring);
    }
  } catch (const Error&) {
    // It needs a part that no model here has; the parameters that it read until then are known.
  }
  if (sensor) {
    plugin.link_of(params);
    read_common(params, plugin.kind());
  }
  return params.docs();
}

// Some read more once they know, say, which model they are to be.
PluginDoc describe(const std::string& library, const Plugin& plugin) {
  std::vector<ParamDoc> docs = params_of(library, plugin, {});
  const std::vector<ParamDoc> first = docs;
  for (const ParamDoc& param : first) {
    if (param.path.find('/') != std::string::npos) continue;
    for (const std::string& choice : param.choices) {
      if (choice == param.fallback) continue;
      for (ParamDoc& more : params_of(library, plugin, {Element{param.path, choice}})) {
        const bool known = std::any_of(docs.begin(), docs.end(),
                                       [&](const ParamDoc& doc) { return doc.path == more.path; });
        if (known) continue;
        more.doc = "with " + param.path + " " + choice + ": " + more.doc;
        docs.push_back(std::move(more));
      }
    }
  }
  return {library, plugin.kind(), !plugin.makes_sensors(), docs};
}

}  // namespace

std::vector<PluginDoc> describe(Catalog& catalog, const std::string& library) {
  std::vector<PluginDoc> docs;
  for (const auto& plugin : catalog.library(library)) {
    docs.push_back(describe(library.substr(library.rfind('/') + 1), *plugin));
  }
  return docs;
}

std::vector<PluginDoc> describe(Catalog& catalog) {
  std::vector<PluginDoc> docs;
  for (const std::string& library : catalog.available()) {
    try {
      for (PluginDoc& doc : describe(catalog, library)) docs.push_back(std::move(doc));
    } catch (const Error& problem) {
      docs.push_back({library, Kind("", problem.what()), false, {}});
    }
  }
  return docs;
}

}  // namespace angen

#pragma once

#include <memory>
#include <string>

#include "plugin/plugin.h"

namespace angen::devices {

/// The light of a model: on, off, or dimmed in percent of its luminous flux.
class Lamp : public Device {
 public:
  void configure(Params& params, Wiring& wiring) override;
  Verdict command(const Command& command, const View& view) override;
  void update(const View& view, Outputs& outputs) override;
  void report(const View& view, Reading& state) const override;
  void save(SavedParams& params) const override { params.number("level", level_); }
  Nanoseconds idle_until(const View&) const override { return lit_ == level_ ? kForever : 0; }

 private:
  LightRef light_;
  double full_flux_ = 0.0;    // lm at 100 %
  double illuminance_ = 0.0;  // lx at 100 %, of a directional light
  double full_power_ = 0.0;   // W at 100 %
  double level_ = 0.0;        // percent
  double lit_ = -1.0;         // percent that the world was given last
};

class LampPlugin : public Plugin {
 public:
  const Kind& kind() const override;
  bool serves(const ModelInfo& model) const override { return !model.lights.empty(); }
  std::string needs() const override { return "a light"; }
  std::string instance_name(const ModelInfo& model) const override;
  std::unique_ptr<Device> make_device() const override { return std::make_unique<Lamp>(); }
};

}  // namespace angen::devices

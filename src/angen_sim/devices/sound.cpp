#include "devices/sound.h"

namespace angen::devices {

void Sound::configure(Params& params, double level, const char* level_doc) {
  level_ = params.number("sound_power_level", level, "dB", level_doc, {-100.0, 200.0});
  directivity_ = params.number("directivity", 2.0, "",
                               "of its sound: 1 in free air, 2 on a floor or wall, 4 in an edge",
                               {0.1, 1000.0});
  position_ = params.row("position", position_, "m", "x y z in the model's frame where it sounds");
}

void Sound::report(double level, Reading& state) const {
  state.set("sound_power_level", level);
  state.set("directivity", directivity_);
  state.set("position", position_);
}

Kind Sound::describe(Kind kind) {
  kind.number("sound_power_level", "dB", "over 1 pW; minus infinity where it is silent")
      .number("directivity", "", "of its sound")
      .numbers("position", "m", "x y z in the model's frame where it sounds");
  return kind;
}

}  // namespace angen::devices

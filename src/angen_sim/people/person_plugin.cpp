// libperson_controller.so
#include <algorithm>
#include <iterator>

#include "people/person.h"
#include "plugin/registration.h"

namespace angen::people {

const Kind& PersonPlugin::kind() const {
  static const Kind kind =
      Kind("person", "A person who walks a path.")
          .travels("people")
          .example("set person walker stop")
          .verb("Stop", "stops where the person is")
          .verb("Go", "walks on: to where it was sent, or along its path")
          .place_verb("GoTo",
                      "walks there, through doors and round obstacles; to another floor by "
                      "an elevator")
          .pair_verb("PushTo", "x y", "m", {}, "walks there straight, and pushes obstacles")
          .verb("Follow", "walks on along its path")
          .place_verb("Sit", "sits down on the seat there, at most 1.4 m away")
          .optional()
          .place_verb("Lie", "lies down on the bed there, at most 2.2 m away, or on the floor")
          .optional()
          .verb("Stand", "gets up, and stays")
          .verb("CloseDoors", "from now on shuts the doors that it walks through")
          .verb("LeaveDoors", "from now on leaves them open")
          .verb("Speak", "speaks until Quiet")
          .verb("Quiet", "speaks no more")
          .choice("mode", {std::begin(kModes), std::end(kModes)},
                  "BLOCKED: an obstacle is in the way")
          .shown()
          .number("x", "m", "in the world")
          .shown(2)
          .number("y", "m", "in the world")
          .shown(2)
          .number("z", "m", "in the world")
          .number("yaw", "rad", "in the world")
          .number("speed", "m/s", "horizontal")
          .shown(2)
          .flag("going", "whether it is on its way to where it was sent")
          .flag("unreachable", "whether it has given up where it was sent")
          .text("why", "why it has given up; empty otherwise")
          .flag("speaking", "whether the person speaks")
          .number("sound_power_level", "dB",
                  "of steps and speech, over 1 pW; minus infinity: silent")
          .number("heat", "W", "that it gives to the air of its room")
          .number("vapor", "g/h", "of its breath and skin, that it gives to that air")
          .numbers("position", "m", "of the mouth, in the model's frame");
  return kind;
}

bool PersonPlugin::serves(const ModelInfo& model) const {
  return std::find(model.links.begin(), model.links.end(), "body") != model.links.end();
}

}  // namespace angen::people

ANGEN_REGISTER_PLUGIN(angen::people::PersonPlugin)

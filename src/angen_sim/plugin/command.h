#pragma once

#include <string>
#include <vector>

#include "plugin/kind.h"

namespace angen {

/// A command for one device: the text after the target's name.
struct Command {
  std::string text;  // the text sent: "Open", "Dim 40"; empty if it has values alone
  // A text of numbers alone (of a drive: m/s, rad/s; as many zeros if it is Stop), or the
  // numbers of a verb that takes several.
  std::vector<double> values = {};
  std::string verb = {};   // one of the kind's, written as there; none if the kind has none
  double number = 0.0;     // the number of a verb that takes one, within its range
  std::string place = {};  // the name that a verb of places took instead of numbers
};

/// Finds the kind's verb in `command.text` ("Dim 40", "dim, 40", "Floor1") and fills in verb and
/// number. Returns the error in the text and the right forms, "" where it is right. A kind
/// without verbs takes any text; numbers alone become values.
std::string parse_command(const Kind& kind, Command& command);

/// Whether the text is a verb of the kind, or one with its integer, such as Floor1.
bool is_verb(const Kind& kind, const std::string& text);

/// "On, Off and Dim <percent>".
std::string forms_of(const Kind& kind);

}  // namespace angen

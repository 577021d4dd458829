#pragma once

#include <string>
#include <utility>
#include <vector>

#include "plugin/range.h"

namespace angen {

/// A word that commands take, with a number or without one.
struct Verb {
  std::string name;       // "Dim", as commands write it; upper and lower case are the same
  std::string doc;        // one line
  std::string argument;   // what the number is: "percent"; empty where the verb takes none
  std::string unit;       // of the number
  Range range;            // of the number
  bool whole = false;     // the number is an integer; it may follow the verb without a blank
  std::size_t count = 1;  // how many numbers it takes, where it takes any; `argument` names each
};

/// A field of a sensor's reading or a device's state.
struct Field {
  enum class Type { kFlag, kInteger, kNumber, kText, kChoice, kNumbers, kTexts, kImage };

  std::string name;
  Type type = Type::kNumber;
  std::string unit;
  std::string doc;
  std::vector<std::string>
      words;         // of a choice, its values; of a flag in a summary, for yes and no
  int decimals = 0;  // of a number in a summary
  bool in_summary = false;
  std::string names;        // of numbers in a summary: the field of texts that names each of them
  bool as_percent = false;  // a summary shows a share of 1 as a percentage
  bool alarm = false;       // a flag that is yes while the sensor detects what it is for
};

const char* name_of(Field::Type type);  // "flag", "number", …

/// All that is known of a kind of sensor or device. The command line, its help and completion, the
/// command topics, `angen plugins`, rviz's captions and the tables of docs/ come from it.
class Kind {
 public:
  /// A model of worlds/models that holds one; used where `parameter` (if any) is set to `value`.
  struct Model {
    std::string folder;
    std::string parameter;
    std::string value;
  };

  Kind(std::string name, std::string doc) : name(std::move(name)), doc(std::move(doc)) {}

  std::string name;           // "pir"
  std::string doc;            // one line
  double rate = 10.0;         // Hz, how often a sensor publishes unless its SDF says
  bool is_on_demand = false;  // a sensor that samples only while somebody subscribes to it
  std::vector<Model> models;  // the first is the default
  std::string sensor_type;    // SDF type of one that is mounted on a link of another model
  std::string example_line;   // arguments of `angen` that spawn or command one
  std::string command_topic;  // std_msgs/String "VERB, NAME[, NUMBER]"; none: /angen/command only
  std::vector<Verb> verbs;
  std::vector<std::string> value_units;  // of one commanded by numbers alone: "m/s", "rad/s"
  std::vector<Field> fields;
  std::string ray_color;  // of a sensor whose rays rviz draws: "r g b a", 0 to 1; <color> overrides

  // Each adds to the description and returns it, so that calls can be chained.

  Kind& publishes_at(double hz);
  Kind& on_demand();
  Kind& model(std::string folder, std::string parameter = "", std::string value = "");
  /// Mounted on a link of another model, as <sensor type=`sdf_type`>.
  Kind& on_link(std::string sdf_type);
  Kind& example(std::string line);
  Kind& commanded_on(std::string topic);
  /// rviz draws Sensor::rays in this color, as long as its field `ranges` says.
  Kind& rays(std::string color);

  Kind& verb(std::string name, std::string doc);
  Kind& verb(std::string name, std::string argument, std::string unit, Range range,
             std::string doc);
  /// A verb that takes two numbers, as "GoTo 1.5 2"; `arguments` is "x y".
  Kind& pair_verb(std::string name, std::string arguments, std::string unit, Range range,
                  std::string doc);
  /// A verb whose number is an integer.
  Kind& counted_verb(std::string name, std::string argument, Range range, std::string doc);

  /// A command may be that many numbers, without a verb.
  Kind& values(std::vector<std::string> units);

  Kind& flag(std::string name, std::string doc);
  Kind& integer(std::string name, std::string unit, std::string doc);
  Kind& number(std::string name, std::string unit, std::string doc);
  Kind& text(std::string name, std::string doc);
  Kind& choice(std::string name, std::vector<std::string> words, std::string doc);
  Kind& numbers(std::string name, std::string unit, std::string doc);
  Kind& texts(std::string name, std::string doc);
  Kind& image(std::string name, std::string doc);

  /// Of the field that was added last: it is a part of the summary, a number with so many decimals.
  Kind& shown(int decimals = 0);
  /// The same for numbers, each after its text in the field `names`.
  Kind& shown_by_name(std::string names, int decimals = 0);
  /// The same for a share of 1, as a percentage.
  Kind& shown_as_percent(int decimals = 0);
  /// The same for a flag, by these words.
  Kind& shown_as(std::string yes, std::string no);
  /// The same, and it is an alarm: shown in red in rviz while it is yes.
  Kind& alarm(std::string yes, std::string no);

 private:
  Kind& add(std::string name, Field::Type type, std::string unit, std::string doc);
};

}  // namespace angen

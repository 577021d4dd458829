#pragma once

#include <string>
#include <utility>
#include <vector>

#include "plugin/range.h"

namespace angen {

/// A word that commands take, with a number or without one.
struct Verb {
  std::string name;          // "Dim", as commands write it; upper and lower case are the same
  std::string doc;           // one line
  std::string argument;      // meaning of the number: "percent"; empty if the verb has none
  std::string unit;          // unit of the number
  Range range;               // limits of the number
  bool whole = false;        // the number is an integer; it may follow the verb without a blank
  std::size_t count = 1;     // how many numbers it takes, where it takes any; `argument` names each
  bool is_optional = false;  // it may have none
  bool is_place = false;     // it also takes a third number, a floor, or a name instead of all
};

/// A field of a sensor's reading or a device's state.
struct Field {
  enum class Type { kFlag, kInteger, kNumber, kText, kChoice, kNumbers, kTexts, kImage };

  std::string name;
  Type type = Type::kNumber;
  std::string unit;
  std::string doc;
  std::vector<std::string> words;  // a choice's values; a flag's words for yes and no in a summary
  int decimals = 0;                // decimals of a number in a summary
  bool in_summary = false;
  std::string names;        // the field of texts that names each number in a summary
  bool as_percent = false;  // a summary shows a share of 1 as a percentage
  bool alarm = false;       // a flag that is yes while the sensor detects its target
  std::string begin_event;  // the event of a flag's change to `in_alarm`; empty: none
  std::string end_event;    // and of its change back
  bool in_alarm = true;     // the flag's value while the sensor detects something
  std::string with;         // "model range_difference": the parameter's value that it exists with
};

const char* name_of(Field::Type type);  // "flag", "number", …

/// All that is known of a kind of sensor or device. The command line, its help and completion, the
/// command topics, `angen plugins`, rviz's captions and the tables of docs/ come from it.
class Kind {
 public:
  /// The role of a device in the description of the home: a leaf on a hinge, or an elevator.
  enum class Passage { kNone, kDoor, kWindow, kElevator };

  /// A model of worlds/models that holds one; used where `parameter` (if any) is set to `value`.
  struct Model {
    std::string folder;
    std::string parameter;
    std::string value;
  };

  Kind(std::string name, std::string doc)
      : name(std::move(name)), doc(std::move(doc)), group_(this->name + "s") {}

  std::string name;           // "pir"
  std::string doc;            // one line
  bool is_on_demand = false;  // a sensor that samples only while it has subscribers
  std::vector<Model> models;  // the first is the default
  std::vector<Verb> verbs;
  std::vector<Field> fields;

  Passage passage() const { return passage_; }
  /// Hz, how often a sensor publishes unless its SDF says.
  double rate() const { return rate_; }
  /// SDF type of a sensor that is mounted on a link of another model.
  const std::string& sensor_type() const { return sensor_type_; }
  /// Arguments of `angen` that spawn or command one.
  const std::string& example() const { return example_; }
  /// std_msgs/String "VERB, NAME[, NUMBER]"; empty: /angen/command only.
  const std::string& command_topic() const { return command_topic_; }
  /// Units of the numbers of a command without a verb: "m/s", "rad/s".
  const std::vector<std::string>& value_units() const { return value_units_; }
  /// The group of its model in viewers, KIND + "s" if none is given; empty of a small part of a
  /// model, which is grouped as without it.
  const std::string& group() const { return group_; }
  /// Whether its model changes storeys: its group is of none.
  bool changes_storeys() const { return travels_ || passage_ == Passage::kElevator; }
  /// Whether its model moves through the building.
  bool travels() const { return travels_; }
  /// "r g b a", 0 to 1, in which rviz draws Sensor::rays(), as long as the field `ranges` says;
  /// <color> overrides it. Empty: it draws none.
  const std::string& ray_color() const { return ray_color_; }

  // Each adds to the description and returns it, so that calls can be chained.

  Kind& passage(Passage passage) { return set(passage_, passage); }
  Kind& rate(double hz) { return set(rate_, hz); }
  Kind& on_demand() { return set(is_on_demand, true); }
  Kind& model(std::string folder, std::string parameter = "", std::string value = "");
  Kind& sensor_type(std::string sdf_type) { return set(sensor_type_, std::move(sdf_type)); }
  Kind& example(std::string line) { return set(example_, std::move(line)); }
  Kind& command_topic(std::string topic) { return set(command_topic_, std::move(topic)); }
  Kind& value_units(std::vector<std::string> units) { return set(value_units_, std::move(units)); }
  Kind& group(std::string group_name) { return set(group_, std::move(group_name)); }
  Kind& travels(std::string group_name) { return set(travels_, true).group(std::move(group_name)); }
  Kind& ray_color(std::string color) { return set(ray_color_, std::move(color)); }

  Kind& verb(std::string name, std::string doc);
  Kind& verb(std::string name, std::string argument, std::string unit, Range range,
             std::string doc);
  /// A verb that takes two numbers, as "GoTo 1.5 2"; `arguments` is "x y".
  Kind& pair_verb(std::string name, std::string arguments, std::string unit, Range range,
                  std::string doc);
  /// A verb that takes a place: x and y in m, maybe the number of a floor, or a name.
  Kind& place_verb(std::string name, std::string doc);
  /// The place of the verb that was added last may be left out.
  Kind& optional() { return set(verbs.back().is_optional, true); }
  /// A verb whose number is an integer.
  Kind& counted_verb(std::string name, std::string argument, Range range, std::string doc);

  Kind& flag(std::string name, std::string doc);
  Kind& integer(std::string name, std::string unit, std::string doc);
  Kind& number(std::string name, std::string unit, std::string doc);
  Kind& text(std::string name, std::string doc);
  Kind& choice(std::string name, std::vector<std::string> words, std::string doc);
  Kind& numbers(std::string name, std::string unit, std::string doc);
  Kind& texts(std::string name, std::string doc);
  Kind& image(std::string name, std::string doc);

  /// The field that was added last exists only if this parameter has this value. Another field
  /// may have the same name with another value.
  Kind& with(const std::string& parameter, const std::string& value) {
    return set(fields.back().with, parameter + " " + value);
  }
  /// The summary shows the field that was added last, a number with this number of decimals.
  Kind& shown(int decimals = 0);
  /// Shows numbers, each after its text in the field `names`.
  Kind& shown_by_name(std::string names, int decimals = 0);
  /// Shows a share of 1 as a percentage.
  Kind& shown_as_percent(int decimals = 0);
  /// Shows a flag by these words.
  Kind& shown_as(std::string yes, std::string no);
  /// Shows a flag that is an alarm: red in rviz while it is yes.
  Kind& alarm(std::string yes, std::string no);
  /// The events of a sensor when the flag that was added last changes to `in_alarm`, and back. A
  /// false alarm, which is a fault of the sensor, is such a change.
  Kind& events(std::string begin, std::string end, bool in_alarm = true);

 private:
  Kind& add(std::string name, Field::Type type, std::string unit, std::string doc);
  template <class Member, class Value>
  Kind& set(Member& member, Value&& value) {
    member = std::forward<Value>(value);
    return *this;
  }

  Passage passage_ = Passage::kNone;
  double rate_ = 10.0;
  std::string sensor_type_;
  std::string example_;
  std::string command_topic_;
  std::vector<std::string> value_units_;
  std::string ray_color_;
  std::string group_;
  bool travels_ = false;
};

}  // namespace angen

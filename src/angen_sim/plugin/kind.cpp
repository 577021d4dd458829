#include "plugin/kind.h"

namespace angen {

const char* name_of(Field::Type type) {
  switch (type) {
    case Field::Type::kFlag:
      return "flag";
    case Field::Type::kInteger:
      return "integer";
    case Field::Type::kNumber:
      return "number";
    case Field::Type::kText:
      return "text";
    case Field::Type::kChoice:
      return "choice";
    case Field::Type::kNumbers:
      return "numbers";
    case Field::Type::kTexts:
      return "texts";
    case Field::Type::kImage:
      return "image";
  }
  return "";
}

Kind& Kind::passage(Passage passage) {
  passage_ = passage;
  return *this;
}

Kind& Kind::rate(double hz) {
  rate_ = hz;
  return *this;
}

Kind& Kind::on_demand() {
  is_on_demand = true;
  return *this;
}

Kind& Kind::model(std::string folder, std::string parameter, std::string value) {
  models.push_back({std::move(folder), std::move(parameter), std::move(value)});
  return *this;
}

Kind& Kind::sensor_type(std::string sdf_type) {
  sensor_type_ = std::move(sdf_type);
  return *this;
}

Kind& Kind::example(std::string line) {
  example_ = std::move(line);
  return *this;
}

Kind& Kind::command_topic(std::string topic) {
  command_topic_ = std::move(topic);
  return *this;
}

Kind& Kind::group(std::string group_name) {
  group_ = std::move(group_name);
  return *this;
}

Kind& Kind::travels(std::string group_name) {
  travels_ = true;
  return group(std::move(group_name));
}

Kind& Kind::ray_color(std::string color) {
  ray_color_ = std::move(color);
  return *this;
}

Kind& Kind::verb(std::string verb_name, std::string verb_doc) {
  verbs.push_back({std::move(verb_name), std::move(verb_doc), "", "", {}, false});
  return *this;
}

Kind& Kind::verb(std::string verb_name, std::string argument, std::string unit, Range range,
                 std::string verb_doc) {
  verbs.push_back({std::move(verb_name), std::move(verb_doc), std::move(argument), std::move(unit),
                   range, false});
  return *this;
}

Kind& Kind::pair_verb(std::string verb_name, std::string arguments, std::string unit, Range range,
                      std::string verb_doc) {
  verb(std::move(verb_name), std::move(arguments), std::move(unit), range, std::move(verb_doc));
  verbs.back().count = 2;
  return *this;
}

Kind& Kind::place_verb(std::string verb_name, std::string verb_doc) {
  pair_verb(std::move(verb_name), "x y", "m", {}, std::move(verb_doc));
  verbs.back().is_place = true;
  return *this;
}

Kind& Kind::optional() {
  verbs.back().is_optional = true;
  return *this;
}

Kind& Kind::counted_verb(std::string verb_name, std::string argument, Range range,
                         std::string verb_doc) {
  verbs.push_back(
      {std::move(verb_name), std::move(verb_doc), std::move(argument), "", range, true});
  return *this;
}

Kind& Kind::value_units(std::vector<std::string> units) {
  value_units_ = std::move(units);
  return *this;
}

Kind& Kind::flag(std::string field, std::string field_doc) {
  return add(std::move(field), Field::Type::kFlag, "", std::move(field_doc));
}

Kind& Kind::integer(std::string field, std::string unit, std::string field_doc) {
  return add(std::move(field), Field::Type::kInteger, std::move(unit), std::move(field_doc));
}

Kind& Kind::number(std::string field, std::string unit, std::string field_doc) {
  return add(std::move(field), Field::Type::kNumber, std::move(unit), std::move(field_doc));
}

Kind& Kind::text(std::string field, std::string field_doc) {
  return add(std::move(field), Field::Type::kText, "", std::move(field_doc));
}

Kind& Kind::choice(std::string field, std::vector<std::string> words, std::string field_doc) {
  add(std::move(field), Field::Type::kChoice, "", std::move(field_doc));
  fields.back().words = std::move(words);
  return *this;
}

Kind& Kind::numbers(std::string field, std::string unit, std::string field_doc) {
  return add(std::move(field), Field::Type::kNumbers, std::move(unit), std::move(field_doc));
}

Kind& Kind::texts(std::string field, std::string field_doc) {
  return add(std::move(field), Field::Type::kTexts, "", std::move(field_doc));
}

Kind& Kind::image(std::string field, std::string field_doc) {
  return add(std::move(field), Field::Type::kImage, "", std::move(field_doc));
}

Kind& Kind::with(const std::string& parameter, const std::string& value) {
  fields.back().with = parameter + " " + value;
  return *this;
}

Kind& Kind::shown(int decimals) {
  fields.back().in_summary = true;
  fields.back().decimals = decimals;
  return *this;
}

Kind& Kind::shown_by_name(std::string names, int decimals) {
  fields.back().names = std::move(names);
  return shown(decimals);
}

Kind& Kind::shown_as_percent(int decimals) {
  fields.back().as_percent = true;
  return shown(decimals);
}

Kind& Kind::shown_as(std::string yes, std::string no) {
  fields.back().in_summary = true;
  fields.back().words = {std::move(yes), std::move(no)};
  return *this;
}

Kind& Kind::alarm(std::string yes, std::string no) {
  fields.back().alarm = true;
  return shown_as(std::move(yes), std::move(no));
}

Kind& Kind::events(std::string begin, std::string end, bool in_alarm) {
  Field& flag = fields.back();
  flag.begin_event = std::move(begin);
  flag.end_event = std::move(end);
  flag.in_alarm = in_alarm;
  return *this;
}

Kind& Kind::add(std::string field, Field::Type type, std::string unit, std::string field_doc) {
  Field added;
  added.name = std::move(field);
  added.type = type;
  added.unit = std::move(unit);
  added.doc = std::move(field_doc);
  fields.push_back(std::move(added));
  return *this;
}

}  // namespace angen

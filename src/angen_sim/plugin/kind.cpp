#include "plugin/kind.h"

namespace angen {

const char* name_of(Field::Type type) {
  constexpr const char* kNames[] = {"flag",   "integer", "number", "text",
                                    "choice", "numbers", "texts",  "image"};
  return kNames[static_cast<std::size_t>(type)];
}

Kind& Kind::model(std::string folder, std::string parameter, std::string value) {
  models.push_back({std::move(folder), std::move(parameter), std::move(value)});
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

Kind& Kind::counted_verb(std::string verb_name, std::string argument, Range range,
                         std::string verb_doc) {
  verbs.push_back(
      {std::move(verb_name), std::move(verb_doc), std::move(argument), "", range, true});
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
  return set(fields.back().words, std::move(words));
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

Kind& Kind::shown(int decimals) {
  return set(fields.back().in_summary, true).set(fields.back().decimals, decimals);
}

Kind& Kind::shown_by_name(std::string names, int decimals) {
  return set(fields.back().names, std::move(names)).shown(decimals);
}

Kind& Kind::shown_as_percent(int decimals) {
  return set(fields.back().as_percent, true).shown(decimals);
}

Kind& Kind::shown_as(std::string yes, std::string no) {
  fields.back().words = {std::move(yes), std::move(no)};
  return set(fields.back().in_summary, true);
}

Kind& Kind::alarm(std::string yes, std::string no) {
  return set(fields.back().alarm, true).shown_as(std::move(yes), std::move(no));
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

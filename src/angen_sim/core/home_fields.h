#pragma once

#include "core/home.h"

/// The fields of a home's parts, each listed once, as dicts of Python and messages of ROS name
/// them: visit_fields(part, visit) calls visit(name, value, of_message) for each, in order;
/// of_message(message) is the field of a message that has fields of these names.
namespace angen {

#define ANGEN_FIELD_FROM(name, value) \
  visit(                              \
      #name, value, [](auto& message) -> auto& { return message.name; })
#define ANGEN_FIELD(name) ANGEN_FIELD_FROM(name, part.name)

template <class Visit>
void visit_fields(const Storey& part, Visit&& visit) {
  ANGEN_FIELD(number);
  ANGEN_FIELD(name);
  ANGEN_FIELD(elevation);
  ANGEN_FIELD(height);
}

template <class Visit>
void visit_fields(const Room& part, Visit&& visit) {
  ANGEN_FIELD(name);
  ANGEN_FIELD(use);
  ANGEN_FIELD(storey);
  ANGEN_FIELD_FROM(polygon, part.outline);
  ANGEN_FIELD(holes);
  ANGEN_FIELD(floor);
  ANGEN_FIELD(ceiling);
  ANGEN_FIELD(area);
  ANGEN_FIELD(guessed);
}

template <class Visit>
void visit_fields(const Place& part, Visit&& visit) {
  ANGEN_FIELD(posture);
  ANGEN_FIELD(pose);
}

template <class Visit>
void visit_fields(const Thing& part, Visit&& visit) {
  ANGEN_FIELD(name);
  ANGEN_FIELD(type);
  ANGEN_FIELD(room);
  ANGEN_FIELD(pose);
  ANGEN_FIELD(places);
}

template <class Visit>
void visit_fields(const HomeDoor& part, Visit&& visit) {
  ANGEN_FIELD(name);
  ANGEN_FIELD_FROM(kind, std::string(name_of(part.kind)));
  ANGEN_FIELD(rooms);
  ANGEN_FIELD(width);
  ANGEN_FIELD(height);
  ANGEN_FIELD(pose);
  ANGEN_FIELD(partner);
}

template <class Visit>
void visit_fields(const Landing& part, Visit&& visit) {
  ANGEN_FIELD(storey);
  ANGEN_FIELD(room);
  ANGEN_FIELD(pose);
}

template <class Visit>
void visit_fields(const HomeElevator& part, Visit&& visit) {
  ANGEN_FIELD(name);
  ANGEN_FIELD(pose);
  ANGEN_FIELD(landings);
}

template <class Visit>
void visit_fields(const Home& part, Visit&& visit) {
  ANGEN_FIELD(entrance);
  ANGEN_FIELD(north);
  ANGEN_FIELD(latitude);
  ANGEN_FIELD(start);
  ANGEN_FIELD(storeys);
  ANGEN_FIELD(rooms);
  ANGEN_FIELD(things);
  ANGEN_FIELD(doors);
  ANGEN_FIELD(elevators);
}

#undef ANGEN_FIELD
#undef ANGEN_FIELD_FROM

}  // namespace angen

#include "sdf/home.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "core/limits.h"
#include "core/lists.h"
#include "core/names.h"
#include "core/nearest.h"
#include "core/text.h"
#include "document/values.h"
#include "document/xml.h"

namespace angen::load {

namespace {

constexpr double kSmallestRoom = 0.01;  // m^2
constexpr std::size_t kMaxRoomCorners = 10'000;

const std::string kRoom = "angen:room";
const std::string kStorey = "angen:storey";
const std::string kOpening = "angen:opening";
const std::string kThing = "angen:thing";
const std::string kPlace = "angen:place";
const std::string kHome = "angen:home";

std::string known_word(const std::string& word, const std::vector<std::string>& known,
                       const Element& at, const std::string& what) {
  if (is_in(word, known)) return word;
  throw Error(at.source, what + " is '" + printable(word) + "'; known are " + join_names(known));
}

// Names of a home are texts for people: they may contain characters that topics may not.
std::string checked_label(std::string name, const Element& element) {
  std::string problem = label_problem(name);
  if (problem.empty() && !name.empty() && (name.front() == ' ' || name.back() == ' ')) {
    problem = "the name '" + printable(name) + "' begins or ends with a blank; leave it out";
  }
  if (!problem.empty()) throw Error(element.source, "<" + element.name + ">: " + problem);
  return name;
}

std::string label_of(const Element& element) {
  std::string name = checked_label(name_of(element), element);
  if (name.empty()) {
    throw Error(element.source, "<" + element.name + "> has no name; write name=\"kitchen\"");
  }
  return name;
}

// x y z yaw
FloorPose floor_pose(const Element& element, const Pose& frame) {
  const std::vector<double> v = numbers_of(element, 4);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::string problem = limit_problem(i < 3 ? limits::kPosition : limits::kAngle, v[i]);
    if (!problem.empty()) throw Error(element.source, "<" + element.name + ">: " + problem);
  }
  return {frame * Vec3(v[0], v[1], v[2]), std::remainder(v[3] + yaw_of(frame.rotation), 2 * M_PI)};
}

Polygon polygon_of(const Element& element, const std::string& room) {
  const std::string what = "<" + element.name + "> of room '" + printable(room) + "'";
  const Numbers found = numbers_in(element.text);
  if (!found.bad.empty()) {
    throw Error(element.source, what + " contains '" + printable(found.bad) +
                                    "', which is not a number; write x y of each corner");
  }
  const std::size_t count = found.values.size();
  if (count % 2 != 0 || count < 6 || count > 2 * kMaxRoomCorners) {
    throw Error(element.source, what + " has " + std::to_string(count) +
                                    " numbers; write x y of three corners or more");
  }
  Polygon polygon;
  for (std::size_t i = 0; i < count; i += 2) {
    for (const double value : {found.values[i], found.values[i + 1]}) {
      const std::string problem = limit_problem(limits::kPosition, value);
      if (problem.empty()) continue;
      throw Error(element.source, what + " has " + number_text(value) + " m; " + problem);
    }
    polygon.emplace_back(found.values[i], found.values[i + 1]);
  }
  if (polygon.front() == polygon.back()) polygon.pop_back();
  if (const auto edges = crossing_edges(polygon); edges || polygon.size() < 3) {
    const auto edge = [&](std::size_t i) {
      const auto corner = [&](std::size_t k) {
        const Point2& point = polygon[k % polygon.size()];
        return "(" + number_text(point.x()) + ", " + number_text(point.y()) + ")";
      };
      return corner(i) + " to " + corner(i + 1);
    };
    throw Error(element.source, what +
                                    (edges ? " crosses itself: its edge " + edge((*edges)[0]) +
                                                 " intersects the edge " + edge((*edges)[1])
                                           : " has two corners") +
                                    "; give its corners once, in order");
  }
  if (std::abs(signed_area(polygon)) < kSmallestRoom) {
    throw Error(element.source, what + " has an area of " +
                                    number_text(std::abs(signed_area(polygon))) +
                                    " m^2; it must be at least 0.01 m^2");
  }
  if (signed_area(polygon) < 0.0) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

void put_into(const Pose& frame, Polygon& polygon) {
  for (Point2& point : polygon) point = (frame * Vec3(point.x(), point.y(), 0.0)).head<2>();
}

desc::Room room_of(const Element& element, const Pose& frame, Session& session) {
  const Reader reader(element, session);
  desc::Room room;
  room.name = label_of(element);
  room.source = element.source;
  if (const Element* use = reader.child("angen:use")) {
    room.use = known_word(use->text, room_uses(), *use, "<angen:use>");
  }
  room.outline = polygon_of(reader.need("angen:polygon"), room.name);
  for (const Element& child : element.children) {
    if (child.name != "angen:hole") continue;
    room.holes.push_back(polygon_of(child, room.name));
    for (const Point2& corner : room.holes.back()) {
      if (contains(room.outline, corner)) continue;
      throw Error(child.source, "<angen:hole> of room '" + printable(room.name) +
                                    "' has a corner (" + number_text(corner.x()) + ", " +
                                    number_text(corner.y()) +
                                    ") outside of the room; it must be inside");
    }
  }
  reader.note({"angen:hole"});
  room.floor = reader.number("angen:floor", 0.0, Range::any(limits::kPosition));
  room.ceiling = reader.number("angen:ceiling", room.ceiling, Range::positive(limits::kLength));
  room.floor = (frame * Vec3(room.outline[0].x(), room.outline[0].y(), room.floor)).z();
  put_into(frame, room.outline);
  for (Polygon& hole : room.holes) put_into(frame, hole);
  return room;
}

desc::Storey storey_of(const Element& element, const Pose& frame, Session& session) {
  const Reader reader(element, session);
  desc::Storey storey;
  storey.source = element.source;
  storey.name = checked_label(name_of(element), element);
  const std::string* number = reader.attribute("number");
  const std::optional<int> value = number == nullptr ? std::nullopt : parse_integer(*number);
  if (!value || std::abs(*value) > 1000) {
    throw Error(element.source,
                "<angen:storey> has no number from -1000 to 1000; write number=\"0\"");
  }
  storey.number = *value;
  storey.elevation =
      frame.position.z() + reader.need_number("angen:elevation", Range::any(limits::kPosition));
  storey.height = reader.number("angen:height", Range::positive(limits::kLength));
  return storey;
}

desc::Opening opening_of(const Element& element, const Pose& frame, Session& session) {
  const Reader reader(element, session);
  desc::Opening opening;
  opening.source = element.source;
  opening.name = label_of(element);
  opening.pose = floor_pose(reader.need("angen:pose"), frame);
  opening.width = reader.need_number("angen:width", Range::positive(limits::kLength));
  opening.height = reader.number("angen:height", 2.1, Range::positive(limits::kLength));
  return opening;
}

Place place_of(const Element& element, const Pose& frame, Session& session) {
  const std::string* posture = Reader(element, session).attribute("posture");
  if (posture == nullptr) {
    throw Error(element.source,
                "<angen:place> has no posture; known are " + join_names(postures()));
  }
  return {known_word(*posture, postures(), element, "the posture of <angen:place>"),
          floor_pose(element, frame)};
}

template <class Part>
void check_new(const std::vector<Part>& parts, const Part& part, const std::string& what) {
  for (const Part& other : parts) {
    if (other.name.empty() || other.name != part.name) continue;
    throw Error(part.source, what + " '" + printable(part.name) +
                                 "' is given twice, first at line " +
                                 std::to_string(other.source.line) + "; give it another name");
  }
}

bool is_date(const std::string& text) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0, length = 0;
  const int count = std::sscanf(text.c_str(), "%4d-%2d-%2dT%2d:%2d:%2d%n", &year, &month, &day,
                                &hour, &minute, &second, &length);
  if (count != 6 || static_cast<std::size_t>(length) != text.size() || text.size() != 19)
    return false;
  const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  const int days[] = {31, leap ? 29 : 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  return year >= 1 && month >= 1 && month <= 12 && day >= 1 && day <= days[month - 1] &&
         hour >= 0 && hour < 24 && minute >= 0 && minute < 60 && second >= 0 && second < 60;
}

}  // namespace

bool is_of_home(const std::string& element) {
  static const std::set<std::string> names = {kRoom, kStorey, kOpening, kThing, kPlace};
  return names.count(element) != 0;
}

void read_home_parts(const Reader& parent, const Pose& frame, desc::HomeParts& to,
                     Session& session) {
  const bool in_world = parent.element().name == "world";
  for (const Element& child : parent.element().children) {
    if (child.name == kStorey) {
      desc::Storey storey = storey_of(child, frame, session);
      check_new(to.storeys, storey, "storey");
      to.storeys.push_back(std::move(storey));
    } else if (child.name == kRoom) {
      desc::Room room = room_of(child, frame, session);
      check_new(to.rooms, room, "room");
      to.rooms.push_back(std::move(room));
    } else if (child.name == kOpening) {
      desc::Opening opening = opening_of(child, frame, session);
      check_new(to.openings, opening, "opening");
      to.openings.push_back(std::move(opening));
    } else if (in_world && (child.name == kThing || child.name == kPlace)) {
      throw Error(child.source, "<" + child.name + "> in <world>; write it in a <model>");
    } else if (child.name == kThing) {
      known_word(child.text, thing_types(), child, "<angen:thing>");
      if (to.thing.empty()) to.thing = child.text;  // a nested model is a part of it
    } else if (child.name == kPlace) {
      to.places.push_back(place_of(child, frame, session));
    } else if (child.name == kHome && !in_world) {
      throw Error(child.source,
                  "<angen:home> in <" + parent.element().name + ">; write it in the <world>");
    }
  }
  parent.note({"angen:thing", "angen:place"});
}

desc::HomeSite home_site_of(const Reader& world, Session& session) {
  desc::HomeSite site;
  const Element* found = world.child(kHome);
  if (found == nullptr) return site;
  for (const Element& child : world.element().children) {
    if (child.name == kHome && &child != found) {
      throw Error(child.source, "a second <angen:home>, first at line " +
                                    std::to_string(found->source.line) + "; keep one");
    }
  }
  const Reader home(*found, session);
  site.source = found->source;
  if (const Element* entrance = home.child("angen:entrance")) {
    site.entrance = checked_label(entrance->text, *entrance);
  }
  site.north = home.number("angen:north", Range::any(limits::kAngle));
  site.latitude = home.number("angen:latitude", Range::any({"deg", 90.0}));
  site.start = home.text("angen:start");
  if (!site.start.empty() && !is_date(site.start)) {
    throw Error(home.need("angen:start").source,
                "<angen:start> is '" + printable(site.start) +
                    "', which is not a date and time; write 2026-03-21T07:00:00");
  }
  return site;
}

}  // namespace angen::load

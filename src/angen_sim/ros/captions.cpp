#include "ros/captions.h"

#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>
#include <vector>

#include "core/diagnostics.h"
#include "ros/marker_shapes.h"

namespace angen::node {
namespace {

constexpr double kHeight = 0.08;  // m, of a capital letter

struct Caption {
  std::string text;
  bool fired = false;
};

std::string number(double value, int places, const char* unit) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(places) << value << " " << unit;
  return text.str();
}

Caption pressure(const Reading& reading) {
  return {number(reading.get<double>("load"), 0, "kg"), reading.get<bool>("pressed")};
}

Caption reed(const Reading& reading) {
  const bool closed = reading.get<bool>("closed");
  return {closed ? "closed" : "open", !closed};
}

Caption rfid(const Reading& reading) {
  const auto ids = reading.get<std::vector<std::string>>("ids");
  return {ids.empty() ? "no tag" : join_names(ids), !ids.empty()};
}

Caption plug(const Reading& reading) {
  const auto power = reading.get<double>("power");
  return {number(power, 0, "W"), power > 0.0};
}

Caption battery(const Reading& reading) {
  return {number(100.0 * reading.get<double>("percentage"), 0, "%"), reading.get<bool>("empty")};
}

Caption temperature(const Reading& reading) {
  return {number(reading.get<double>("temperature"), 1, "°C")};
}

Caption humidity(const Reading& reading) {
  return {number(reading.get<double>("humidity"), 0, "% RH")};
}

using Say = Caption (*)(const Reading&);
const std::map<std::string, Say> kSay = {
    {"battery", &battery},        {"humidity", &humidity}, {"plug", &plug},
    {"pressure", &pressure},      {"reed", &reed},         {"rfid", &rfid},
    {"temperature", &temperature}};

}  // namespace

bool has_caption(const std::string& kind) { return kSay.count(kind) != 0; }

visualization_msgs::Marker draw_caption(const std::string& kind, const Reading* reading) {
  const auto say = kSay.find(kind);
  Caption caption;
  if (reading != nullptr && say != kSay.end()) caption = say->second(*reading);
  visualization_msgs::Marker marker;
  marker.type = visualization_msgs::Marker::TEXT_VIEW_FACING;
  marker.scale.z = kHeight;
  marker.text = caption.text;
  marker.color = caption.fired ? color(0.85F, 0.1F, 0.1F, 1.0F) : color(0.1F, 0.15F, 0.3F, 1.0F);
  return marker;
}

}  // namespace angen::node

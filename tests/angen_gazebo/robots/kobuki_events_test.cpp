#include <gtest/gtest.h>

#include <limits>

#include "robot.h"

// Cliffs, wheel drops and bumper of a Kobuki whose sensors a file describes beside the plug-in.
namespace angen::robots {
namespace {

constexpr double kHeight = 0.06;  // m, of its cliff sensors, which are inside its body
constexpr double kAhead = 0.14;   // m, from its axle to them
constexpr double kTilt = 0.3;     // rad to the right, of the first ray of each

std::string cliff_sensor(const std::string& part, double y) {
  return "<sensor name='" + part + "_eye' type='ray'><pose>" + std::to_string(kAhead) + " " +
         std::to_string(y) + " " + std::to_string(kHeight) +
         " 0 1.5707963267948966 0</pose><ray><scan><horizontal><samples>3</samples><min_angle>-" +
         std::to_string(kTilt) +
         "</min_angle><max_angle>0.1</max_angle></horizontal></scan><range>"
         "<min>0.01</min><max>0.15</max></range></ray></sensor>";
}

const std::string kEyes =
    cliff_sensor("left", 0.09) + cliff_sensor("front", 0.0) + cliff_sensor("right", -0.09);

std::string contact_sensor(const std::string& name, const std::string& collision) {
  return "<sensor name='" + name + "' type='contact'><contact><collision>" + collision +
         "</collision></contact></sensor>";
}

/// `text` with `more` in the link of that name.
std::string in_link(std::string text, const std::string& link, const std::string& more) {
  const std::string start = "<link name='" + link + "'>";
  return text.insert(text.find(start) + start.size(), more);
}

std::string kobuki(const std::string& more, const std::string& beside = "") {
  return robot(plugin("kobuki",
                      "<left_wheel_joint_name>left_joint</left_wheel_joint_name>"
                      "<right_wheel_joint_name>right_joint</right_wheel_joint_name>"
                      "<wheel_separation>0.3</wheel_separation><wheel_diameter>0.1"
                      "</wheel_diameter><torque>5</torque><velocity_command_timeout>60"
                      "</velocity_command_timeout>" +
                          more) +
               beside);
}

std::string cliffs(double threshold) {
  return "<cliff_sensor_left_name>left_eye</cliff_sensor_left_name><cliff_sensor_center_name>"
         "front_eye</cliff_sensor_center_name><cliff_sensor_right_name>right_eye"
         "</cliff_sensor_right_name><cliff_detection_threshold>" +
         std::to_string(threshold) + "</cliff_detection_threshold>";
}

const std::string kDrops =
    "<wheel_drop_left_sensor_name>drop_left</wheel_drop_left_sensor_name>"
    "<wheel_drop_right_sensor_name>drop_right</wheel_drop_right_sensor_name>";

std::string with_drops(const std::string& text) {
  return in_link(in_link(text, "left", contact_sensor("drop_left", "c")), "right",
                 contact_sensor("drop_right", "c"));
}

std::string block(const std::string& pose, const std::string& size) {
  return "<model name='block'><static>true</static><pose>" + pose +
         "</pose><link name='l'><collision name='c'><geometry><box><size>" + size +
         "</size></box></geometry></collision></link></model>";
}

/// "left center", of the flags that are set.
std::string set_in(const Hall& hall, const std::string& kind) {
  const Reading reading = hall.reading(kind);
  std::string parts;
  for (const char* part : {"left", "center", "right"}) {
    if (reading.get<bool>(part, false)) parts += std::string(parts.empty() ? "" : " ") + part;
  }
  return parts;
}

void put(Hall& hall, double height) {
  hall.simulation.post(sim::Edit{sim::SetModelState{
      "bot", {"", {{0.0, 0.0, height}, Quat::Identity()}, Vec3::Zero(), Vec3::Zero()}}});
}

TEST(KobukiCliff, IsTheRangeOfTheFirstRayBelowTheRobot) {
  const std::string low = block("0.14 -0.11 0.01 0 0 0", "0.2 0.08 0.02");  // below the right one
  const std::string own = in_link(kobuki(cliffs(0.05)), "body", kEyes);
  const std::string fixed =
      kobuki(cliffs(0.05), "<link name='eyes'>" + kEyes +
                               "</link><joint name='j' type='fixed'><parent>body"
                               "</parent><child>eyes</child></joint>");
  for (const std::string& text : {own, fixed}) {
    Hall hall(text + low);
    hall.run(1.0);
    const std::vector<double> ranges = list(hall.reading("kobuki_cliff"), "ranges");
    EXPECT_NEAR(ranges[0], kHeight / std::cos(kTilt), 0.001);
    EXPECT_NEAR(ranges[1], kHeight / std::cos(kTilt), 0.001);
    EXPECT_NEAR(ranges[2], (kHeight - 0.02) / std::cos(kTilt), 0.001);
    EXPECT_EQ(set_in(hall, "kobuki_cliff"), "left center");
    EXPECT_FALSE(hall.warns("measures nothing"));
    EXPECT_FALSE(hall.warns("cliff_sensor")) << hall.warnings.front();
  }
}

TEST(KobukiCliff, ComesAndGoesAtTheEdgeOfATable) {
  constexpr double kEdge = 0.3;
  std::string text = in_link(kobuki(cliffs(0.08)), "body", kEyes);
  text = text.insert(text.find("<link"), "<pose>0 0 0.5 0 0 0</pose>");
  Hall hall(text + block("-0.7 0 0.25 0 0 0", "2 2 0.5"));
  hall.run(1.0);
  EXPECT_EQ(set_in(hall, "kobuki_cliff"), "");
  int changes = 0;
  std::string before;
  for (const double speed : {0.1, -0.1}) {
    hall.command("kobuki", {speed, 0.0});
    for (int i = 0; i < 110; ++i) {
      hall.run(0.02);
      const double past = hall.pose().position.x() + kAhead - kEdge;
      const std::string now = set_in(hall, "kobuki_cliff");
      if (std::abs(past) > 0.004) {
        EXPECT_EQ(now, past > 0.0 ? "left center right" : "") << past;
      }
      if (now != before) ++changes;
      before = now;
    }
  }
  EXPECT_EQ(changes, 2);
}

TEST(KobukiEvents, OfARobotThatIsLiftedAndPutDownAgain) {
  Hall hall(with_drops(in_link(kobuki(cliffs(0.08) + kDrops), "body", kEyes)));
  hall.run(2.0);
  EXPECT_EQ(set_in(hall, "kobuki_cliff"), "");
  EXPECT_EQ(set_in(hall, "kobuki_wheel_drop"), "");
  put(hall, 1.0);
  hall.run(0.1);
  EXPECT_EQ(set_in(hall, "kobuki_cliff"), "left center right");
  EXPECT_EQ(set_in(hall, "kobuki_wheel_drop"), "left right");
  EXPECT_EQ(list(hall.reading("kobuki_cliff"), "ranges"),
            std::vector<double>(3, std::numeric_limits<double>::infinity()));
  put(hall, 0.0);
  hall.run(1.0);
  EXPECT_EQ(set_in(hall, "kobuki_cliff"), "");
  EXPECT_EQ(set_in(hall, "kobuki_wheel_drop"), "");
}

TEST(KobukiEvents, OfARobotAtRestCostNoTicks) {
  Hall hall(with_drops(in_link(kobuki(cliffs(0.08) + kDrops), "body", kEyes)));
  hall.run(5.0);
  const Nanoseconds end = hall.snapshot->time + 60 * kSecond;
  int landings = 0;
  while (hall.simulation.snapshot()->time < end) {
    hall.simulation.leap(end);
    ++landings;
  }
  EXPECT_LT(landings, 10) << "in place of 3000 samples";
}

TEST(KobukiEvents, NeedNoSensors) {
  Hall named(kobuki(cliffs(0.01) + kDrops + "<bumper_name>bumpers</bumper_name>"));
  named.run(0.1);
  EXPECT_EQ(set_in(named, "kobuki_cliff") + set_in(named, "kobuki_wheel_drop"), "");
  for (const char* missing :
       {"<cliff_sensor_left_name> is 'left_eye', but the model has no ray sensor of that name",
        "<cliff_sensor_center_name>", "<cliff_sensor_right_name>", "<wheel_drop_left_sensor_name>",
        "<wheel_drop_right_sensor_name>",
        "<bumper_name> is 'bumpers', but the model has no contact sensor of that name"}) {
    EXPECT_EQ(std::count_if(
                  named.warnings.begin(), named.warnings.end(),
                  [&](const std::string& each) { return each.find(missing) != std::string::npos; }),
              1)
        << missing;
  }
  Hall silent(kobuki(""));
  EXPECT_TRUE(silent.warnings.empty()) << silent.warnings.front();
}

TEST(KobukiBumper, IsWhatItsContactSensorWatches) {
  const std::string wall = block("0.4 0 0.5 0 0 0", "0.1 4 1");
  const std::string named = "<bumper_name>bumpers</bumper_name>";
  for (const auto& [sensor, part, warning] :
       std::vector<std::tuple<std::string, std::string, std::string>>{
           {contact_sensor("bumpers", "b"), "center", ""},
           {contact_sensor("bumpers", "ball"), "", ""},
           {contact_sensor("bumpers", "lump"), "center", "has no collision 'lump'"},
           {"", "center", "no contact sensor"}}) {
    Hall hall(in_link(kobuki(named), "body", sensor) + wall);
    hall.command("kobuki", {0.3, 0.0});
    hall.run(2.0);
    EXPECT_GT(hall.pose().position.x(), 0.19) << "at the wall";
    EXPECT_EQ(set_in(hall, "kobuki_bumper"), part) << sensor;
    EXPECT_EQ(hall.warnings.empty(), warning.empty()) << sensor;
    EXPECT_TRUE(warning.empty() || hall.warns(warning)) << warning;
  }
}

}  // namespace
}  // namespace angen::robots

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "robot.h"

// Elements of <gazebo reference> for links, and elements of a URDF that SDF does not have.
namespace angen::robots {
namespace {

std::string link(const std::string& name, const std::string& geometry, double mass = 1.0) {
  const std::string i = std::to_string(mass * 0.004);
  return "<link name='" + name + "'><inertial><mass value='" + std::to_string(mass) +
         "'/><inertia ixx='" + i + "' iyy='" + i + "' izz='" + i +
         "' ixy='0' ixz='0' iyz='0'/></inertial><collision><geometry>" + geometry +
         "</geometry></collision></link>";
}

const char* const kBall = "<sphere radius='0.1'/>";
const char* const kBox = "<box size='0.2 0.2 0.2'/>";

std::string reference(const std::string& name, const std::string& more) {
  return "<gazebo reference='" + name + "'>" + more + "</gazebo>";
}

/// An empty hall into which a URDF is spawned.
struct Urdf : Hall {
  Urdf(const std::string& more, double height) : Hall("", true) {
    const std::string text = "<robot name='bot'>" + more + "</robot>";
    load::SearchPaths paths;
    auto done = simulation.post(
        sim::Spawn{load::model(text, "bot", {{0, 0, height}, Quat::Identity()}, paths, true)});
    run(0.001);
    const sim::Outcome outcome = done.get();
    said = outcome.message;
    if (!outcome.ok) throw Error(said);
  }
  double height(const std::string& name) const { return pose("bot::" + name).position.z(); }
  std::string said;
};

TEST(Urdf, GravityMayBeOffForALink) {
  for (const char* off : {"<gravity>false</gravity>", "<turnGravityOff>true</turnGravityOff>"}) {
    Urdf hall(link("body", kBall) + reference("body", off), 1.0);
    hall.run(0.5);
    EXPECT_NEAR(hall.height("body"), 1.0, 1e-6) << off;
  }
  Urdf falls(link("body", kBall) + reference("body", "<gravity>true</gravity>"), 2.0);
  falls.run(0.5);
  EXPECT_NEAR(falls.height("body"), 2.0 - 0.5 * 9.8 * 0.25, 0.01);
}

TEST(Urdf, ElementsThatUrdfDoesNotHaveMayHoldAnything) {
  const std::string joint =
      "<joint name='j' type='continuous'><parent link='body'/><child link='arm'/>"
      "<axis xyz='0 0 1'/><joint_properties friction='{unset}'/></joint>";
  Urdf hall(link("body", kBall) + link("arm", kBall) + joint, 1.0);
  EXPECT_NEAR(hall.height("arm"), 1.0, 0.01);
  const std::string wrong =
      "<joint name='j' type='continuous'><parent link='body'/>"
      "<child link='arm'/><axis xyz='0 0 {unset}'/></joint>";
  EXPECT_THROW(Urdf(link("body", kBall) + link("arm", kBall) + wrong, 1.0), Error);
}

// Robots are spawned at a height of 0 though their wheels are below their origin.
TEST(Urdf, WhatIsSpawnedInTheFloorIsLiftedAndNotThrown) {
  Urdf hall(link("body", kBall, 50.0) + reference("body", "<kp>10000000</kp><kd>1</kd>"), -0.03);
  double highest = 0.0;
  for (int i = 0; i < 1000; ++i) {
    hall.run(0.001);
    highest = std::max(highest, hall.height("body"));
  }
  EXPECT_GT(highest, 0.1) << "out of the floor";
  EXPECT_LT(highest, 0.2) << "1 m/s, which lifts it by 5 cm at most";
  EXPECT_NEAR(hall.height("body"), 0.1, 0.002);
}

TEST(Urdf, LinksThatSelfCollideTouch) {
  const std::string two =
      link("lower", kBox) + link("middle", "<box size='0.01 0.01 0.01'/>", 0.1) +
      link("upper", kBox) +
      "<joint name='a' type='prismatic'><parent link='lower'/><child link='middle'/><origin "
      "xyz='0.5 0 0'/><axis xyz='0 0 1'/><limit lower='-1' upper='1' effort='10' velocity='10'/>"
      "</joint><joint name='b' type='prismatic'><parent link='middle'/><child link='upper'/>"
      "<origin xyz='-0.5 0 0.5'/><axis xyz='0 0 1'/><limit lower='-1' upper='1' effort='10' "
      "velocity='10'/></joint>";
  const std::string both = reference("lower", "<selfCollide>true</selfCollide>") +
                           reference("upper", "<selfCollide>true</selfCollide>");
  Urdf touches(two + both, 0.1);
  touches.run(1.5);
  EXPECT_NEAR(touches.height("upper"), 0.3, 0.01);
  Urdf passes(two + reference("lower", "<selfCollide>true</selfCollide>"), 0.1);
  passes.run(1.5);
  EXPECT_LT(passes.height("upper"), 0.2);
}

// It is m g / kp deep; a drop onto a spring without a damper is twice as deep.
TEST(Urdf, KpAndKdAreASpringAndADamper) {
  for (const auto& [kd, least, most] : {std::tuple(1.0, 1.5, 2.2), {100.0, 0.9, 1.25}}) {
    Urdf hall(
        link("body", kBall) + reference("body", "<kp>1000</kp><kd>" + std::to_string(kd) + "</kd>"),
        0.1);
    const double depth = 9.8 / 1000.0;
    double deepest = 0.0;
    for (int i = 0; i < 500; ++i) {
      hall.run(0.001);
      deepest = std::max(deepest, 0.1 - hall.height("body"));
    }
    EXPECT_GT(deepest, least * depth) << kd;
    EXPECT_LT(deepest, most * depth + 0.001) << kd;
    hall.run(8.0);
    EXPECT_NEAR(0.1 - hall.height("body"), depth, 0.0015) << kd;
  }
}

// It is put 10 mm deep, and parted only where that is too deep.
TEST(Urdf, MinDepthIsHowDeepItMayStand) {
  const auto depth_with = [](double min_depth) {
    const std::string text = "<minDepth>" + std::to_string(min_depth) + "</minDepth>";
    Urdf hall(link("body", kBall) + reference("body", text), 0.09);
    hall.run(2.0);
    return 0.1 - hall.height("body");
  };
  EXPECT_NEAR(depth_with(0.02), 0.01, 1e-4);
  EXPECT_LT(depth_with(0.002), 0.0025);
}

TEST(Urdf, Mu1IsAlongItsDirectionAndMu2Across) {
  const auto slides = [](const std::string& surface, const std::vector<double>& push) {
    Urdf hall(link("body", kBox) + reference("body", surface) + "<gazebo>" +
                  plugin("force", "<bodyName>body</bodyName>") + "</gazebo>",
              0.1);
    hall.run(0.2);
    hall.command("force", {push[0], push[1], 0.0, 0.0, 0.0, 0.0}, "bot_body");
    hall.run(1.0);
    return hall.pose("bot::body").position.head<2>().norm();
  };
  const double push = 0.3 * 9.8;  // N on 1 kg
  EXPECT_NEAR(slides("<mu1>0.2</mu1><mu2>0.2</mu2>", {push, 0.0}), 0.5 * 0.1 * 9.8, 0.03);
  EXPECT_LT(slides("<mu1>0.5</mu1><mu2>0.5</mu2>", {push, 0.0}), 0.002);
  const std::string two = "<mu1>0.1</mu1><mu2>0.6</mu2><fdir1>1 0 0</fdir1>";
  EXPECT_NEAR(slides(two, {push, 0.0}), 0.5 * 0.2 * 9.8, 0.05);
  EXPECT_LT(slides(two, {0.0, push}), 0.005);
}

std::string two_arms(const std::string& of_right, const std::string& more) {
  std::string text =
      "<link name='world'/>" + link("base", "<box size='0.1 0.1 0.1'/>") +
      "<joint name='fix' type='fixed'><parent link='world'/><child link='base'/><origin "
      "xyz='0 0 1'/></joint>";
  for (const std::string name : {"left", "right"}) {
    text += link(name, "<box size='0.02 0.02 0.02'/>") + "<joint name='" + name +
            "_joint' type='revolute'><parent link='base'/><child link='" + name +
            "'/><origin xyz='0 " + (name == "left" ? "0.3" : "-0.3") +
            " 0'/><axis xyz='0 1 0'/><limit lower='-1' upper='1' effort='50' velocity='3'/>" +
            (name == "right" ? of_right : "") + "</joint>";
  }
  return text + more;
}

TEST(Urdf, TransmissionsMakeJointsTakeCommandsAndMimicJointsFollow) {
  const std::string control =
      "<transmission name='t'><type>transmission_interface/SimpleTransmission</type><joint "
      "name='left_joint'><hardwareInterface>hardware_interface/PositionJointInterface"
      "</hardwareInterface></joint><actuator name='m'><mechanicalReduction>1"
      "</mechanicalReduction></actuator></transmission><gazebo><plugin name='c' "
      "filename='libgazebo_ros_control.so'><robotNamespace>/bot</robotNamespace></plugin></gazebo>";
  Urdf hall(two_arms("<mimic joint='left_joint' multiplier='-2' offset='0.1'/>", control), 0.0);
  hall.command("joint_command", {0.3}, "bot_left_joint");
  hall.run(1.5);
  EXPECT_NEAR(angle(hall, "left"), 0.3, 0.002);
  EXPECT_NEAR(angle(hall, "right"), -0.5, 0.005);
}

const char* const kWall =
    "<model name='wall'><static>true</static><link name='l'><collision name='c'><pose>2.1 0 1 0 0 "
    "0</pose><geometry><box><size>0.2 8 2</size></box></geometry></collision><visual name='c'>"
    "<pose>2.1 0 1 0 0 0</pose><geometry><box><size>0.2 8 2</size></box></geometry></visual>"
    "</link></model>";

/// A post before the wall, with a sensor 0.5 m high.
std::string post(const std::string& sensor) {
  return std::string(kWall) +
         "<model name='bot'><static>true</static><link name='body'><pose>0 0 0.5 0 0 0</pose>" +
         sensor + "</link></model>";
}

TEST(Urdf, AGpuLaserMeasuresTheWall) {
  Hall hall(post("<sensor name='s' type='gpu_ray'><update_rate>40</update_rate><ray><scan>"
                 "<horizontal><samples>61</samples><min_angle>-0.6</min_angle><max_angle>0.6"
                 "</max_angle></horizontal></scan><range><min>0.1</min><max>5</max></range></ray>"
                 "<plugin name='p' filename='libgazebo_ros_gpu_laser.so'><topicName>scan"
                 "</topicName><frameName>laser</frameName></plugin></sensor>"),
            true);
  hall.request("lidar");
  hall.run(0.1);
  const std::vector<double> ranges = list(hall.reading("lidar"), "ranges");
  ASSERT_EQ(ranges.size(), 61U);
  for (int i = 0; i < 61; ++i) {
    EXPECT_NEAR(ranges[i], 2.0 / std::cos(-0.6 + 0.02 * i), 1e-6);
  }
}

TEST(Urdf, AMulticameraIsTwoCamerasAndADepthCameraSeesTheWall) {
  const std::string lens =
      "<horizontal_fov>1.0</horizontal_fov><image><width>32</width><height>24</height></image>"
      "<clip><near>0.1</near><far>20</far></clip>";
  Hall hall(post("<sensor name='eyes' type='multicamera'><camera name='left'><pose>0 0.1 0 0 0 0"
                 "</pose>" +
                 lens + "</camera><camera name='right'><pose>0 -0.1 0 0 0 0</pose>" + lens +
                 "</camera><plugin name='p' filename='libgazebo_ros_multicamera.so'>"
                 "<cameraName>stereo</cameraName><hackBaseline>0.2</hackBaseline></plugin>"
                 "</sensor><sensor name='depth' type='depth'><camera>" +
                 lens +
                 "</camera><plugin name='p' filename='libgazebo_ros_depth_camera.so'>"
                 "<cameraName>cam</cameraName><imageTopicName>rgb/image_raw"
                 "</imageTopicName></plugin></sensor>"),
            true);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < hall.snapshot->structure->sensors.size(); ++i) {
    const sim::SensorEntry& sensor = hall.snapshot->structure->sensors[i];
    names.push_back(sensor.name);
    hall.simulation.request(sensor.kind, sensor.name, true);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"bot_eyes_left", "bot_eyes_right", "bot_depth"}));
  hall.run(0.1);
  EXPECT_EQ(hall.snapshot->reading(0)->get<double>("baseline"), 0.0);
  EXPECT_EQ(hall.snapshot->reading(1)->get<double>("baseline"), 0.2);
  EXPECT_EQ(hall.snapshot->structure->sensors[1].pose.position.y(), -0.1);
  const Reading depth = *hall.snapshot->reading(2);
  const auto image = depth.get<FloatImage>("depth");
  ASSERT_NE(image.values, nullptr);
  EXPECT_NEAR((*image.values)[12 * 32 + 16], 2.0, 1e-3);
  EXPECT_NE(depth.get<ByteImage>("image").values, nullptr);
}

// A box pushes a box with a bumper at 10 Hz.
TEST(Urdf, ABumperNamesWhoPushesInEachOfItsReadings) {
  const std::string bumper =
      "<sensor name='bumper' type='contact'><update_rate>10</update_rate><contact><collision>c"
      "</collision></contact><plugin name='p' filename='libgazebo_ros_bumper.so'/></sensor>";
  Hall hall("<model name='bot'>" + box("body", 5.0, "0 0 0.15 0 0 0", "0.3 0.3 0.3", bumper) +
            "</model><model name='pusher'>" + box("body", 40.0, "-0.5 0 0.3 0 0 0", "0.3 0.3 0.6") +
            plugin("planar_move", "") + "</model>");
  hall.run(0.5);
  hall.command("planar_move", {0.5, 0.0, 0.0}, "pusher");
  hall.run(0.6);  // it arrives after 0.4 s
  int named = 0;
  for (int i = 0; i < 14; ++i) {
    hall.run(0.1);
    for (const std::string& other :
         hall.reading("contact").get<std::vector<std::string>>("collision2")) {
      if (other == "pusher::body::c") {
        ++named;
        break;
      }
    }
  }
  EXPECT_EQ(named, 14);
  hall.command("planar_move", {-0.5, 0.0, 0.0}, "pusher");
  hall.run(0.5);
  for (const std::string& other :
       hall.reading("contact").get<std::vector<std::string>>("collision2")) {
    EXPECT_EQ(other.find("pusher"), std::string::npos);
  }
}

}  // namespace
}  // namespace angen::robots

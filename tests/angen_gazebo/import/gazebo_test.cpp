#include <gtest/gtest.h>

#include <algorithm>

#include "angen_sim/sdf/texts.h"
#include "document/xml.h"
#include "sdf/load.h"

namespace angen::load {
namespace {

desc::Model bumper(const std::string& parameters, bool tolerant) {
  SearchPaths paths;
  paths.default_dialect = DefaultDialect::kAuto;
  return model(
      "<sdf version='1.6'><model name='bot'><link name='l'><collision name='c'><geometry><box>"
      "<size>1 1 1</size></box></geometry></collision><sensor name='s' type='contact'><contact>"
      "<collision>c</collision></contact><plugin name='p' filename='libgazebo_ros_bumper.so'>" +
          parameters + "</plugin></sensor></link></model></sdf>",
      "bot", {}, paths, tolerant);
}

std::string said(const desc::Model& model, const std::string& parameter) {
  return model.links.at(0).sensors.at(0).plugin_element.child_text(parameter, "none");
}

TEST(GazeboModel, ABumperThatSaysNothingHasGazebosTopicAndFrame) {
  EXPECT_EQ(said(bumper("", true), "bumperTopicName"), "bumper_states");
  EXPECT_EQ(said(bumper("", true), "frameName"), "world");
  const desc::Model given =
      bumper("<bumperTopicName>touch</bumperTopicName><frameName>l</frameName>", true);
  EXPECT_EQ(said(given, "bumperTopicName"), "touch");
  EXPECT_EQ(said(given, "frameName"), "l");
  EXPECT_EQ(said(bumper("<topicName>/t</topicName>", true), "bumperTopicName"), "none");
  EXPECT_EQ(said(bumper("", false), "bumperTopicName"), "none") << "Angen's own models";
}

const desc::Joint* joint(const desc::Model& model, const std::string& name) {
  const auto found = std::find_if(model.joints.begin(), model.joints.end(),
                                  [&](const desc::Joint& each) { return each.name == name; });
  return found == model.joints.end() ? nullptr : &*found;
}

std::string link(const std::string& name) {
  return "<link name='" + name +
         "'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>"
         "</inertial></link>";
}

std::string fixed(const std::string& name, const std::string& parent, const std::string& child) {
  return "<joint name='" + name + "' type='fixed'><parent link='" + parent + "'/><child link='" +
         child + "'/><origin xyz='0 0 0.5'/></joint>";
}

TEST(GazeboModel, AFixedJointThatIsMeasuredStays) {
  const desc::Model arm =
      model("<robot name='arm'>" + link("a") + link("b") + link("c") + fixed("wrist", "a", "b") +
                fixed("plate", "b", "c") +
                "<gazebo><plugin name='ft' filename='libgazebo_ros_ft_sensor.so'><jointName>wrist"
                "</jointName></plugin></gazebo></robot>",
            "arm", {}, {}, true);
  ASSERT_NE(joint(arm, "wrist"), nullptr);
  EXPECT_EQ(joint(arm, "wrist")->type, desc::Joint::Type::kRevolute);
  EXPECT_EQ(joint(arm, "wrist")->axes.at(0).lower, 0.0);
  EXPECT_EQ(joint(arm, "wrist")->axes.at(0).upper, 0.0);
  EXPECT_NEAR(joint(arm, "wrist")->anchor.z(), 0.5, 1e-9);
  EXPECT_EQ(joint(arm, "plate"), nullptr) << "its links are one";
  EXPECT_EQ(arm.links.size(), 2U);
}

TEST(GazeboModel, AJointMayHaveTheNameOfALinkInAFileAsInText) {
  const std::string robot = "<robot name='r'>" + link("body") + link("neck") +
                            "<joint name='neck' type='revolute'><parent link='body'/><child "
                            "link='neck'/><origin xyz='0 0 0.2'/><axis xyz='0 0 1'/><limit "
                            "lower='-1' upper='1' effort='5' velocity='2'/></joint></robot>";
  const Folder folder;
  for (const std::string& what : {robot, folder.write("r.urdf", robot)}) {
    const desc::Model read = model(what, "r", {}, folder.paths(), false);
    ASSERT_EQ(read.links.size(), 2U) << what;
    ASSERT_EQ(read.joints.size(), 1U) << what;
    EXPECT_NEAR(read.links[1].pose.position.z(), 0.2, 1e-9) << what;
    EXPECT_EQ(read.joints[0].axes.at(0).upper, 1.0) << what;
  }
}

}  // namespace
}  // namespace angen::load

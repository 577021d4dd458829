#include "gazebo/model_text.h"

#include <gtest/gtest.h>

#include "core/diagnostics.h"

namespace angen::node::gazebo {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++found;
  return found;
}

TEST(ModelText, TheRootSaysWhatItIs) {
  EXPECT_TRUE(is_urdf("<?xml version='1.0'?><!-- r --><robot name='r'/>"));
  EXPECT_FALSE(is_urdf("<sdf version='1.6'><model name='m'/></sdf>"));
  EXPECT_FALSE(is_urdf("<model name='m'/>"));
  for (const char* wrong : {"", "robot", "<launch/>", "<!-- <robot/>", "<robot>"}) {
    EXPECT_THROW(is_urdf(wrong), Error) << wrong;
  }
}

TEST(ModelText, PluginsWithoutANamespaceGetIt) {
  const std::string xml =
      "<robot name='r'><gazebo><plugin name='a' filename='a.so'/></gazebo><gazebo>"
      "<plugin name='b' filename='b.so'><robotNamespace>own</robotNamespace></plugin></gazebo>"
      "</robot>";
  const std::string given = model_text(xml, "left").xml;
  EXPECT_EQ(count(given, "<robotNamespace>left</robotNamespace>"), 1U) << given;
  EXPECT_EQ(count(given, "<robotNamespace>own</robotNamespace>"), 1U) << given;
  EXPECT_EQ(model_text(xml, "").xml, xml);
  EXPECT_EQ(model_text(xml, "/").xml, xml);
}

// Its own is the model's name, not /: spawn_model gives / where it runs in no namespace.
TEST(ModelText, ControllersGetTheNamespaceOfTheRoot) {
  const std::string xml =
      "<robot name='r'><gazebo><plugin name='a' filename='a.so'/><plugin name='c' "
      "filename='libgazebo_ros_control.so'/></gazebo></robot>";
  const std::string given = model_text(xml, "/").xml;
  EXPECT_EQ(count(given, "<robotNamespace>/</robotNamespace>"), 1U) << given;
  EXPECT_EQ(model_text(xml, "").xml, xml);
}

TEST(ModelText, AnIncludeIsTakenOutOfItsWorld) {
  const ModelText text = model_text(
      "<sdf version='1.4'><world name='default'><include><uri>model://table</uri>"
      "<pose>1 2 3 0 0 0</pose></include></world></sdf>",
      "");
  EXPECT_EQ(text.xml.find("<world"), std::string::npos);
  EXPECT_NE(text.xml.find("<include>"), std::string::npos);
  EXPECT_EQ(text.own_pose.position, Vec3(1, 2, 3));
}

TEST(ModelText, AModelsOwnPoseIsFound) {
  const std::string xml =
      "<sdf version='1.6'><model name='m'><pose>0 0 0.5 0 0 0</pose></model></sdf>";
  EXPECT_EQ(model_text(xml, "").own_pose.position, Vec3(0, 0, 0.5));
  EXPECT_EQ(model_text("<robot name='r'/>", "").own_pose, Pose());
}

}  // namespace
}  // namespace angen::node::gazebo

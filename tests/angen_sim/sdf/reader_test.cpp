#include <gtest/gtest.h>

#include <algorithm>

#include "angen_sim/sdf/texts.h"

namespace angen::load {
namespace {

std::vector<std::string> ignored_in(const std::string& xml, const SearchPaths& paths = {}) {
  std::vector<std::string> found;
  for (const Diagnostic& each : world_from_text(xml, "test.world", paths).ignored) {
    found.push_back(each.text());
  }
  return found;
}

bool has(const std::vector<std::string>& found, const std::string& text) {
  return std::find(found.begin(), found.end(), text) != found.end();
}

TEST(Ignored, IsNothingOfWhatIsUsed) {
  const std::vector<std::string> found = ignored_in(in_world(
      "<gravity>0 0 -9.8</gravity><physics "
      "type='ode'><max_step_size>0.002</max_step_size></physics>"
      "<model name='m'><pose>0 0 1 0 0 0</pose><link name='l'><inertial><mass>2</mass></inertial>" +
      box() + "</link><link name='k'/><joint name='j' type='revolute'><parent>l</parent>" +
      "<child>k</child><axis><xyz>0 0 1</xyz><dynamics><damping>1</damping>" +
      "<spring_stiffness>3</spring_stiffness><spring_reference>0.1</spring_reference></dynamics>" +
      "</axis></joint></model>"));
  EXPECT_TRUE(found.empty()) << found.front();
}

TEST(Ignored, IsListedWithFileAndLine) {
  const std::vector<std::string> found = ignored_in(
      "<sdf version='1.6'>\n<world name='w'>\n<wind><linear_velocity>1 0 "
      "0</linear_velocity></wind>\n"
      "<model name='m'>\n<enable_wind>true</enable_wind>\n<link name='l'>\n"
      "<velocity_decay><linear>0.1</linear></velocity_decay>\n"
      "<collision name='c'><geometry><box><size>1 2 3</size></box></geometry>\n"
      "<max_contacts>4</max_contacts>\n"
      "<surface><contact><ode><max_vel>0.01</max_vel></ode></contact></surface></collision>\n"
      "<visual name='v'><geometry><box><size>1 2 3</size></box></geometry>\n"
      "<cast_shadows>false</cast_shadows></visual>\n"
      "</link></model></world></sdf>");
  const std::vector<std::string> expected = {
      "test.world:3: <wind> in <world>",          "test.world:5: <enable_wind> in <model>",
      "test.world:7: <velocity_decay> in <link>", "test.world:9: <max_contacts> in <collision>",
      "test.world:10: <max_vel> in <ode>",        "test.world:12: <cast_shadows> in <visual>",
  };
  for (const std::string& text : expected) EXPECT_TRUE(has(found, text)) << text;
  EXPECT_EQ(found.size(), expected.size());
}

TEST(Ignored, AnElementThatSdfDoesNotHaveThereIsAWarning) {
  const desc::World world = read(in_link(
      "<visual name='v'>" +
      std::string(
          "<geometry><sphere><radius>2</radius></sphere></geometry>\n<surface/></visual>")));
  ASSERT_EQ(world.warnings.size(), 1U);
  EXPECT_EQ(world.warnings[0].text(),
            "w.world:2: <surface> in <visual> is not known; leave it out");
  EXPECT_TRUE(world.ignored.empty());
}

std::string lidar(const std::string& always_on, const std::string& resolution) {
  return in_link("<sensor name='s' type='ray'><always_on>" + always_on +
                 "</always_on><update_rate>5</update_rate><ray><scan><horizontal>"
                 "<samples>9</samples><resolution>" +
                 resolution +
                 "</resolution></horizontal></scan><range><min>0.1</min><max>3</max></range></ray>"
                 "<plugin name='p' filename='liblidar.so'/></sensor>");
}

TEST(Ignored, OfASensorIsListedUnlessItSaysWhatAngenDoes) {
  EXPECT_TRUE(ignored_in(lidar("true", "1")).empty());
  const std::vector<std::string> found = ignored_in(lidar("false", "2"));
  EXPECT_EQ(found.size(), 2U);
  EXPECT_TRUE(has(found, "test.world:1: <always_on> in <sensor>"));
  EXPECT_TRUE(has(found, "test.world:1: <resolution> in <horizontal>"));
}

TEST(Ignored, SpringsOfAJointOfTwoAxesAndTheAxisOfAFixedOneAre) {
  const std::string dynamics = "<dynamics><spring_stiffness>3</spring_stiffness></dynamics>";
  const std::string links = "<link name='a'/><link name='b'/>";
  const std::string ends = "<parent>a</parent><child>b</child>";
  const std::vector<std::string> two = ignored_in(
      in_model(links + "<joint name='j' type='universal'>" + ends + "<axis><xyz>0 0 1</xyz>" +
               dynamics + "</axis><axis2><xyz>1 0 0</xyz></axis2></joint>"));
  EXPECT_EQ(two.size(), 1U);
  const std::vector<std::string> none = ignored_in(in_model(
      links + "<joint name='j' type='fixed'>" + ends + "<axis><xyz>0 0 1</xyz></axis></joint>"));
  EXPECT_EQ(none.size(), 1U);
}

TEST(Ignored, OfAModelThatIsIncludedTwiceIsListedOnce) {
  const Folder folder;
  folder.model("thing", sdf("<model name='thing'>\n<link name='l'><must_be_base_link>true"
                            "</must_be_base_link></link></model>"));
  const std::string include = "<uri>model://thing</uri></include>";
  const std::vector<std::string> found = ignored_in(
      in_world("<include><name>a</name>" + include + "<include><name>b</name>" + include),
      folder.paths());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].find("thing/model.sdf:2: <must_be_base_link> in <link>"), std::string::npos)
      << found[0];
}

TEST(Ignored, WrittenIntoAnIncludeIsAWarning) {
  const Folder folder;
  folder.model("thing", sdf("<model name='thing'><link name='l'/></model>"));
  const desc::World world =
      world_from_text(in_world("<include><uri>model://thing</uri>\n<nme>x</nme></include>"),
                      "test.world", folder.paths());
  ASSERT_EQ(world.warnings.size(), 1U);
  EXPECT_NE(world.warnings[0].text().find("test.world:2:"), std::string::npos);
  EXPECT_NE(world.warnings[0].text().find("<nme>"), std::string::npos);
}

TEST(Ignored, OfALoneModelIsItsOwn) {
  const desc::Model lone = model(
      "<model name='m'><link name='l'><enable_wind>1</enable_wind></link></model>", "", {}, {});
  ASSERT_EQ(lone.ignored.size(), 1U);
  EXPECT_NE(lone.ignored[0].message.find("<enable_wind>"), std::string::npos);
}

}  // namespace
}  // namespace angen::load

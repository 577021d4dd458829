#include <gtest/gtest.h>

#include "angen_sim/sdf/texts.h"

namespace angen::load {
namespace {

std::string hinge(const std::string& name, const std::string& place,
                  const std::string& extra = "") {
  return "<joint name='" + name + "' type='revolute'><parent>world</parent><child>a</child><pose>" +
         place + "</pose><axis><xyz>0 0 1</xyz><limit><lower>-1.57</lower><upper>0.001</upper>" +
         "</limit>" + extra + "</axis></joint>";
}

std::string arm(const std::string& type, const std::string& safety) {
  return "<robot name='r'><link name='a'><inertial><mass value='1'/>"
         "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>"
         "<link name='b'><inertial><mass value='1'/>"
         "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>"
         "<joint name='j' type='" +
         type +
         "'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/>"
         "<limit lower='-2' upper='2' effort='20' velocity='3'/>" +
         safety + "</joint></robot>";
}

desc::JointSafety safety_in(const std::string& urdf) {
  const Folder folder;
  const desc::Model read = model(folder.write("arm.urdf", urdf), "r", {}, folder.paths());
  for (const desc::Joint& joint : read.joints) {
    if (joint.name == "j") return joint.axes.at(0).safety.value();
  }
  throw std::runtime_error("no joint j");
}

std::string message_of(const std::string& urdf) {
  try {
    safety_in(urdf);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SafetyController, OfAUrdfIsRead) {
  const desc::JointSafety safety = safety_in(
      arm("revolute",
          "<safety_controller soft_lower_limit='-1.5' soft_upper_limit='1.4' k_position='15' "
          "k_velocity='10'/>"));
  EXPECT_DOUBLE_EQ(safety.soft_lower, -1.5);
  EXPECT_DOUBLE_EQ(safety.soft_upper, 1.4);
  EXPECT_DOUBLE_EQ(safety.k_position, 15.0);
  EXPECT_DOUBLE_EQ(safety.k_velocity, 10.0);
}

TEST(SafetyController, SoftLimitsThatAreNotGivenAreTheJointsOwn) {
  const desc::JointSafety safety =
      safety_in(arm("prismatic", "<safety_controller k_position='4' k_velocity='10'/>"));
  EXPECT_DOUBLE_EQ(safety.soft_lower, -2.0);
  EXPECT_DOUBLE_EQ(safety.soft_upper, 2.0);
}

TEST(SafetyController, OfAJointWithoutEndsHasNoSoftLimits) {
  const desc::JointSafety safety = safety_in(arm(
      "continuous", "<safety_controller soft_upper_limit='1' k_position='4' k_velocity='10'/>"));
  EXPECT_DOUBLE_EQ(safety.k_position, 0.0);
  EXPECT_DOUBLE_EQ(safety.k_velocity, 10.0);
}

TEST(SafetyController, WhatIsWrongWithItIsSaid) {
  EXPECT_NE(message_of(arm("revolute",
                           "<safety_controller soft_lower_limit='1' soft_upper_limit='-1' "
                           "k_velocity='10'/>"))
                .find("soft_lower_limit 1 above its soft_upper_limit -1"),
            std::string::npos);
  EXPECT_NE(message_of(arm("revolute", "<safety_controller k_velocity='-1'/>"))
                .find("must not be negative"),
            std::string::npos);
}

TEST(SafetyController, OfAnSdfNeedsItsVelocityGain) {
  const std::string message =
      error_of(in_model(two_links() + hinge("j", "0 0 0 0 0 0",
                                            "<angen:safety_controller><k_position>4</k_position>"
                                            "</angen:safety_controller>")));
  EXPECT_NE(message.find("w.world:1: <safety_controller> has no k_velocity"), std::string::npos)
      << message;
}

TEST(SafetyController, OfAnSdfStandsInItsAxis) {
  const desc::Model m = read_model(
      two_links() + hinge("j", "0 0 0 0 0 0",
                          "<angen:safety_controller><soft_upper_limit>-0.1</soft_upper_limit>"
                          "<k_position>4</k_position><k_velocity>10</k_velocity>"
                          "</angen:safety_controller>"));
  const desc::JointSafety safety = m.joints.at(0).axes.at(0).safety.value();
  EXPECT_DOUBLE_EQ(safety.soft_lower, -1.57);
  EXPECT_DOUBLE_EQ(safety.soft_upper, -0.1);
}

TEST(Poses, OfThreeNumbersArePositionsWithAWarning) {
  const desc::World w = read(in_model(two_links() + hinge("j", "-9.371533 6.509166 2.2"), "1.4"));
  expect_near(w.models.at(0).joints.at(0).anchor, {-9.371533, 6.509166, 2.2});
  ASSERT_EQ(w.warnings.size(), 1U);
  EXPECT_NE(w.warnings[0].text().find("w.world:1: "), std::string::npos) << w.warnings[0].text();
  EXPECT_NE(w.warnings[0].message.find("3 numbers"), std::string::npos);
}

TEST(Hinges, AboutOneLineAreOneJoint) {
  const desc::World w =
      read(in_model(two_links() + hinge("low", "1 2 0.3 0 0 0") + hinge("high", "1 2 1.9 0 0 0")));
  ASSERT_EQ(w.models.at(0).joints.size(), 1U);
  EXPECT_EQ(w.models[0].joints[0].name, "low");
  ASSERT_EQ(w.warnings.size(), 1U);
  EXPECT_NE(w.warnings[0].message.find("joint 'high' joins 'world' and 'a', as joint 'low' does"),
            std::string::npos)
      << w.warnings[0].message;
}

TEST(Hinges, AboutTwoLinesStayTwoWithAWarning) {
  const desc::World w =
      read(in_model(two_links() + hinge("one", "1 2 0 0 0 0") + hinge("other", "1 2.5 0 0 0 0")));
  EXPECT_EQ(w.models.at(0).joints.size(), 2U);
  ASSERT_EQ(w.warnings.size(), 1U);
  EXPECT_NE(w.warnings[0].message.find("neither can turn"), std::string::npos);
}

TEST(Joint, RevoluteWithLimitsAndDynamics) {
  const desc::Joint j =
      read_model(joint("revolute",
                       "<pose>0 0 1 0 0 0</pose><axis><xyz>0 0 2</xyz><limit><lower>-1.57</lower>"
                       "<upper>0.001</upper><effort>150</effort><velocity>3</velocity></limit>"
                       "<dynamics><damping>2</damping><friction>0.5</friction></dynamics></axis>"))
          .joints.at(0);
  EXPECT_EQ(j.type, desc::Joint::Type::kRevolute);
  EXPECT_EQ(j.parent, "a");
  EXPECT_EQ(j.child, "b");
  expect_near(j.anchor, {0.0, 0.0, 1.0});
  expect_near(j.axes.at(0).xyz, {0.0, 0.0, 1.0});
  EXPECT_DOUBLE_EQ(j.axes[0].lower, -1.57);
  EXPECT_DOUBLE_EQ(j.axes[0].upper, 0.001);
  EXPECT_DOUBLE_EQ(j.axes[0].effort, 150.0);
  EXPECT_DOUBLE_EQ(j.axes[0].velocity, 3.0);
  EXPECT_DOUBLE_EQ(j.axes[0].damping, 2.0);
  EXPECT_DOUBLE_EQ(j.axes[0].friction, 0.5);
}

TEST(Joint, WithoutLimitsOrWithInfiniteOnesIsFree) {
  for (const std::string limit : {"", "<limit><lower>-inf</lower><upper>inf</upper></limit>"}) {
    const desc::JointAxis a =
        read_model(joint("revolute", "<axis><xyz>0 0 1</xyz>" + limit + "</axis>"))
            .joints[0]
            .axes.at(0);
    EXPECT_DOUBLE_EQ(a.lower, -1e16);
    EXPECT_DOUBLE_EQ(a.upper, 1e16);
    EXPECT_LT(a.effort, 0.0);
  }
}

TEST(Joint, EveryType) {
  const std::string axis = "<axis><xyz>1 0 0</xyz></axis>";
  using Joint = desc::Joint::Type;
  EXPECT_EQ(read_model(joint("fixed", ""), "1.8").joints[0].type, Joint::kFixed);
  EXPECT_EQ(read_model(joint("ball", ""), "1.8").joints[0].type, Joint::kBall);
  EXPECT_EQ(read_model(joint("prismatic", axis)).joints[0].type, Joint::kPrismatic);
  EXPECT_EQ(read_model(joint("continuous", axis), "1.8").joints[0].type, Joint::kRevolute);
  const desc::Joint universal =
      read_model(joint("universal", axis + "<axis2><xyz>0 1 0</xyz></axis2>")).joints[0];
  EXPECT_EQ(universal.type, Joint::kUniversal);
  ASSERT_EQ(universal.axes.size(), 2U);
  expect_near(universal.axes[1].xyz, {0.0, 1.0, 0.0});
  EXPECT_THROW(read_model(joint("universal", axis + "<axis2><xyz>-2 0 0</xyz></axis2>")), Error);
}

// As in Gazebo Classic: z = -angle / thread_pitch.
TEST(Joint, AScrewHasTheLeadOfItsThreadPitch) {
  const std::string axis = "<axis><xyz>1 0 0</xyz></axis>";
  const desc::Joint screw =
      read_model(joint("screw", axis + "<thread_pitch>-3141.59265</thread_pitch>")).joints[0];
  EXPECT_EQ(screw.type, desc::Joint::Type::kScrew);
  EXPECT_NEAR(2.0 * M_PI * screw.lead, 0.002, 1e-9) << "M16: 2 mm a turn, right-handed";
  EXPECT_DOUBLE_EQ(read_model(joint("screw", axis), "1.5").joints[0].lead, -1.0);
  EXPECT_NE(error_of(in_model(joint("screw", axis + "\n<thread_pitch>0</thread_pitch>")))
                .find("w.world:2: the <thread_pitch> of "),
            std::string::npos);
}

TEST(Joint, ParentMayBeTheWorld) {
  const desc::Model m = read_model(
      "<link name='a'/><joint name='j' "
      "type='fixed'><parent>world</parent><child>a</child></joint>");
  EXPECT_EQ(m.joints.at(0).parent, "world");
}

TEST(Joint, ZeroAxisIsFixedWithOneWarning) {
  const desc::World w = read(in_model("\n" + joint("revolute",
                                                   "<axis><xyz>0 0 0</xyz><limit><lower>0</lower>"
                                                   "<upper>0</upper></limit></axis>")));
  EXPECT_EQ(w.models[0].joints[0].type, desc::Joint::Type::kFixed);
  EXPECT_TRUE(w.models[0].joints[0].axes.empty());
  ASSERT_EQ(w.warnings.size(), 1U);
  EXPECT_EQ(w.warnings[0].source.line, 2);
}

const char* const kTurned =
    "<link name='a'/><link name='b'><pose>0 0 0 0 0 1.5707963267948966</pose></link>"
    "<joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>1 0 0</xyz>";

Vec3 turned_axis(const std::string& more, const std::string& version) {
  return read_model(kTurned + more + "</axis></joint>", version).joints[0].axes[0].xyz;
}

TEST(JointAxis, IsTheModelsUntil14) { expect_near(turned_axis("", "1.4"), {1.0, 0.0, 0.0}); }
TEST(JointAxis, IsTheLinksFrom15) { expect_near(turned_axis("", "1.5"), {0.0, 1.0, 0.0}); }
TEST(JointAxis, IsTheModelsWhereItSaysSo) {
  expect_near(turned_axis("<use_parent_model_frame>1</use_parent_model_frame>", "1.6"),
              {1.0, 0.0, 0.0});
}

}  // namespace
}  // namespace angen::load

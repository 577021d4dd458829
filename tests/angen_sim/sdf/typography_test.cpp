#include "angen_sim/sdf/texts.h"

namespace angen::load {
namespace {

const char kMinus[] = "\u2212";

TEST(Typography, MinusSignsAreReadWithAWarning) {
  const desc::World w = read(
      "<sdf version='1.6'><world name='w'><model name='m'>\n"
      "<pose>\u22129.371533 6.509166 0.1 0 0 \u20131.7</pose><link "
      "name='l'/></model></world></sdf>");
  expect_near(w.models[0].pose, {{-9.371533, 6.509166, 0.1}, from_rpy(0.0, 0.0, -1.7)});
  ASSERT_EQ(w.warnings.size(), 1U);
  EXPECT_EQ(w.warnings[0].text(),
            "w.world:2: <pose> contains the typographic character \u2212 (U+2212); it is read as "
            "'-9.371533 6.509166 0.1 0 0 -1.7'; write that");
}

TEST(Typography, AModelFilesNumbersAreReadWithAWarning) {
  const Folder folder;
  const std::string file = folder.write(
      "m.sdf", sdf("<model name='m'><link name='a'/><link name='b'/>"
                   "<joint name='j' type='revolute'><parent>a</parent><child>b</child><axis>"
                   "<xyz>0 0 1</xyz><limit>\n<lower>\u22121.570000</lower><upper>0.001</upper>"
                   "</limit></axis></joint></model>"));
  const desc::Model m = model(file, "", {}, {});
  EXPECT_DOUBLE_EQ(m.joints.at(0).axes.at(0).lower, -1.57);
  ASSERT_EQ(m.warnings.size(), 1U);
  EXPECT_EQ(m.warnings[0].text().find(file + ":2: <lower> contains"), 0U) << m.warnings[0].text();
}

TEST(Typography, AUrdfsAttributesAreReadWithAWarning) {
  const Folder folder;
  const std::string inertial =
      "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/>"
      "</inertial></link>";
  const std::string file = folder.write(
      "r.urdf", "<robot name='r'><link name='a'>" + inertial + "<link name='b'>" + inertial +
                    "\n<joint name='j' type='continuous'><parent link='a'/><child link='b'/>\n"
                    "<origin xyz='1 \u22122 3' rpy='0 0 0'/><axis xyz='0 0 1'/></joint></robot>");
  const desc::Model m = model(file, "", {}, {});
  EXPECT_EQ(m.warnings.at(0).text().find(file + ":3: <origin xyz> contains"), 0U)
      << m.warnings[0].text();
  expect_near(m.links.at(1).pose.position, {1.0, -2.0, 3.0});
}

TEST(Typography, APluginsNumbersAndALoneModelsAreRead) {
  const desc::Model m = model(std::string("<model name='m'><link name='l'/><plugin name='p' "
                                          "filename='libp.so'><i_min>") +
                                  kMinus + "100</i_min></plugin></model>",
                              "", {}, {});
  EXPECT_EQ(m.plugins.at(0).element.child("i_min")->text, "-100");
  EXPECT_EQ(m.warnings.size(), 1U);
}

TEST(Typography, NamesAreLeftAlone) {
  const desc::World w = read(in_world("<model name='\u20131'><link name='a \u2013 b'/></model>"));
  EXPECT_EQ(w.models[0].name, "\u20131");
  EXPECT_EQ(w.models[0].links[0].name, "a \u2013 b");
  EXPECT_TRUE(w.warnings.empty());
}

/// Text that is not XML, and its expected error.
void expect_error(const std::string& text, const std::string& start, const std::string& part) {
  const std::string message = error_of(text);
  EXPECT_EQ(message.find(start), 0U) << message;
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(Typography, CurlyQuotesOfAttributesAreNamed) {
  expect_error(
      "<sdf version='1.6'>\n<world name='w'>\n<pose frame=\u201Cx\u201D>0</pose></world></sdf>",
      "w.world:3: the typographic character \u201C (U+201C) in a tag",
      "write name=\"value\" with straight quotes");
  expect_error(
      "<sdf version='1.6'><world name='w'>\n<joint name=\u201Djoint2\u201D "
      "type=\u201Drevolute\u201D/>"
      "</world></sdf>",
      "w.world:2: the typographic character \u201D (U+201D)", "straight quotes");
}

TEST(Typography, AQuoteThatIsCurlyOnlyAtTheEndIsNamed) {
  expect_error("<sdf version='1.6'>\n<world name=\"w\u201D>\n<model name=\"m\"/></world></sdf>",
               "w.world:2: the typographic character \u201D (U+201D)", "straight quotes");
}

TEST(Typography, DashesOfACommentAreNamed) {
  expect_error(
      "<sdf version='1.6'><world name='w'>\n<!\u2212\u2212effort>10</effort>"
      "<velocity>5</velocity\u2212\u2212>\n</world></sdf>",
      "w.world:2: the typographic character \u2212 (U+2212)", "<!-- and -->");
}

TEST(Typography, BlanksInTagsAreNamed) {
  expect_error("<sdf version='1.6'><world name='w'>\n<pose\u00A0frame='x'/></world></sdf>",
               "w.world:2: the typographic character a blank (U+00A0)", "plain blank");
}

TEST(Typography, CommentsAndTextMayHoldIt) {
  const std::string fine =
      "<!-- name=\u201Cx\u201D \u2212 --><plugin name='p' "
      "filename='p.so'><note>\u201Cx\u201D</note></plugin>";
  EXPECT_TRUE(read(in_world(fine)).models.empty());
  // The error there is another one.
  expect_error(
      "<sdf version='1.6'>\n<!-- \u201Cx\u201D -->\n<world name='w'>\n<model></world></sdf>",
      "w.world:4: ", "not closed");
}

}  // namespace
}  // namespace angen::load

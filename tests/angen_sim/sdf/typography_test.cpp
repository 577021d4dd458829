#include "angen_sim/sdf/texts.h"

// SDF and URDF that were copied from a PDF.
namespace angen::load {
namespace {

TEST(Typography, NumbersAndTagsAreReadAsMeant) {
  const desc::World w = read(
      "<sdf version='1.6'><world name=\u201Dw\u201D><model name=\"m\u201D>\n"
      "<!\u2212\u2212effort>10</effort><velocity>5</velocity\u2212\u2212>"
      "<pose\u00A0relative_to='world'>\u22129.371533 6.509166 0.1 0 0 \u20131.7</pose>"
      "<link name='l'/></model></world></sdf>");
  expect_near(w.models.at(0).pose, {{-9.371533, 6.509166, 0.1}, from_rpy(0.0, 0.0, -1.7)});
  EXPECT_TRUE(w.warnings.empty());
}

TEST(Typography, NumbersOfAUrdfAreReadAsMeant) {
  const std::string inertial =
      "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/>"
      "</inertial></link>";
  const desc::Model m =
      model("<robot name='r'><link name='a'>" + inertial + "<link name='b'>" + inertial +
                "<joint name='j' type='continuous'><parent link='a'/><child link='b'/>"
                "<origin xyz='1 \u22122 3' rpy='0 0 0'/><axis xyz='0 0 1'/></joint></robot>",
            "", {}, {});
  expect_near(m.links.at(1).pose.position, {1.0, -2.0, 3.0});
}

TEST(Typography, NamesAndTextsStay) {
  const desc::World w = read(
      in_world("<!-- name=\u201Cx\u201D \u2212 --><model name='\u20131'><link name='a \u2013 b'/>"
               "<plugin name='p' filename='p.so'><note>\u201Cx\u201D</note></plugin></model>"));
  EXPECT_EQ(w.models.at(0).name, "\u20131");
  EXPECT_EQ(w.models[0].links.at(0).name, "a \u2013 b");
  EXPECT_EQ(w.models[0].plugins.at(0).element.child_text("note"), "\u201Cx\u201D");
}

TEST(Typography, ErrorsKeepTheirLine) {
  const std::string error = error_of(
      "<sdf version='1.6'>\n<!-- \u201Cx\u201D -->\n<world name='w'>\n<model></world></sdf>");
  EXPECT_EQ(error.find("w.world:4: the element opened here is not closed"), 0U) << error;
}

}  // namespace
}  // namespace angen::load

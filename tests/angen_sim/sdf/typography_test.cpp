#include "angen_sim/sdf/texts.h"

// SDF that was copied from a PDF.
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

TEST(Typography, NamesAndTextsStay) {
  const desc::World w = read(
      in_world("<!-- name=\u201Cx\u201D \u2212 --><model name='\u20131'><link name='a \u2013 b'/>"
               "<plugin name='p' filename='p.so'><note>\u201Cx\u201D</note></plugin></model>"));
  EXPECT_EQ(w.models.at(0).name, "\u20131");
  EXPECT_EQ(w.models[0].links.at(0).name, "a \u2013 b");
  EXPECT_EQ(w.models[0].plugins.at(0).element.child_text("note"), "\u201Cx\u201D");
}

}  // namespace
}  // namespace angen::load

#include "angen_sim/load/texts.h"

namespace angen::load {
namespace {

// Cut anywhere, a world is an error and never more than that.
TEST(Xml, TruncationIsAlwaysAnError) {
  const std::string text = in_world(
      "<physics type='ode'><max_step_size>0.001</max_step_size></physics>"
      "<light name='sun' type='directional'><direction>0 0 -1</direction></light>"
      "<model name='m'><link name='a'>" +
      box() +
      "</link><link name='b'/><joint name='j' type='revolute'><parent>a</parent><child>b</child>"
      "<axis><xyz>0 0 1</xyz></axis></joint><plugin name='p' filename='libp.so'><q>1</q></plugin>"
      "</model>");
  read(text);
  for (std::size_t length = 0; length < text.size(); length += 50) {
    EXPECT_THROW(read(text.substr(0, length)), Error) << length;
  }
}

TEST(Xml, ElementsAreBounded) {
  std::string many;
  for (int i = 0; i < 100'001; ++i) many += "<x/>";
  EXPECT_NE(error_of(in_world(many)).find("more than 100000 elements"), std::string::npos);
}

TEST(Xml, DepthIsBounded) {
  std::string deep;
  for (int i = 0; i < 5000; ++i) deep += "<model name='m'>";
  EXPECT_NE(error_of("<sdf version='1.6'>" + deep).find("w.world:1: "), std::string::npos);
}

}  // namespace
}  // namespace angen::load

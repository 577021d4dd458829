#include "document/xml.h"

#include <filesystem>
#include <fstream>

#include "angen_sim/sdf/texts.h"

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
  const std::string spaces(kMaxTextBytes, ' ');  // as an apartment building has
  parse_xml(in_world(many + spaces), "w.world");
  for (int i = 0; i < 300'000; ++i) many += "<x/>";
  EXPECT_NE(error_of(in_world(many + spaces)).find("more than 400000 elements"), std::string::npos);
}

TEST(Xml, AMissingFileIsNamedByOneThatIsNear) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "near";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "flat.world") << "<sdf/>";
  const auto problem = [&](const std::string& name) -> std::string {
    try {
      read_file((folder / name).string());
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(problem("flat.wrld").find("did you mean " + (folder / "flat.world").string() + "?"),
            std::string::npos);
  EXPECT_NE(problem("house.world").find("give a file that exists"), std::string::npos);
  EXPECT_EQ(problem("flat.world"), "");
}

// The parser would compare each attribute with all before it: 20,000 took 5 s.
TEST(Xml, AttributesAreBounded) {
  const auto with = [](int count) {
    std::string text = "\n<gui";
    for (int i = 0; i < count; ++i) text += " a" + std::to_string(i) + "='<x y=\"1\">'";
    return in_world(text + "/>");
  };
  read(with(100));
  for (const int count : {101, 200'000}) {
    EXPECT_NE(error_of(with(count)).find("w.world:2: an element with more than 100 attributes"),
              std::string::npos);
  }
  std::string many;
  for (int i = 0; i < 90'000; ++i) many += "<x a='1' b='2' c='3'/>";
  EXPECT_NE(error_of(in_world(many)).find("twice as many attributes"), std::string::npos);
}

TEST(Xml, CommentsAreBounded) {
  std::string many;
  for (int i = 0; i < 100'001; ++i) many += "<!---->";
  EXPECT_NE(error_of(in_world(many)).find("elements or comments"), std::string::npos);
}

TEST(Xml, DepthIsBounded) {
  std::string deep;
  for (int i = 0; i < 5000; ++i) deep += "<model name='m'>";
  EXPECT_NE(error_of("<sdf version='1.6'>" + deep).find("w.world:1: "), std::string::npos);
}

// tinyxml2 reads them; no other program would read the world that is saved.
TEST(Xml, CharactersThatXmlDoesNotAllowAreErrors) {
  for (const std::string reference : {"&#1;", "&#x1F;", "&#xD800;", "&#xFFFF;", "&#x1FFFFF;"}) {
    for (const std::string& text : {"<a b='" + reference + "'/>", "<a>\n" + reference + "</a>"}) {
      EXPECT_NE(error_of(in_world("<gui>" + text + "</gui>")).find("w.world:1: a reference to a"),
                std::string::npos)
          << text;
    }
  }
  EXPECT_NE(error_of(in_world("\n<gui>\x01</gui>")).find("w.world:2: a control character"),
            std::string::npos);
  read(in_world("<gui>&#9;&#xE9;\t&#x1F600;</gui>"));
}

TEST(Xml, PrintedInPlaceEachElementKeepsItsLine) {
  const std::string text = "<a>\n<!-- two\nlines --><b c='1'\n d='&lt;'>\n\ntext</b>\n<e/></a>";
  const Element first = parse_xml(text, "f");
  const Element second = parse_xml(print_xml_in_place(first), "f");
  ASSERT_EQ(second.children.size(), 2U);
  EXPECT_EQ(second.children[0].source.line, first.children[0].source.line);
  EXPECT_EQ(second.children[1].source.line, first.children[1].source.line);
  EXPECT_EQ(second.children[0].text, "text");
  EXPECT_EQ(*second.children[0].attribute("d"), "<");
}

/// Python's ElementTree, as one, writes prefixes of its own for the same names.
TEST(Xml, NamesOfAngenMayHaveAnotherPrefix) {
  const Element read = parse_xml(
      "<sdf xmlns:ns0='angen' ns0:strict='false'><ns0:home xmlns:ns1='urn:other'><ns0:room/>"
      "<ns1:room/></ns0:home></sdf>",
      "w");
  EXPECT_EQ(read.attribute_text("angen:strict"), "false");
  EXPECT_EQ(read.attribute_text("xmlns:angen"), "angen");
  ASSERT_EQ(read.children.at(0).name, "angen:home");
  EXPECT_EQ(read.children[0].children.at(0).name, "angen:room");
  EXPECT_EQ(read.children[0].children.at(1).name, "ns1:room");
}

TEST(Xml, ADeclarationAfterAComment) {
  EXPECT_EQ(parse_xml("<!-- a\n b -->\n<?xml version=\"1.0\"?>\n<sdf/>", "f").source.line, 4);
  const std::string usual = "<?xml version='1.0'?><!-- <?xml?> --><sdf/>";
  EXPECT_EQ(without_late_declaration(usual), usual);
}

TEST(Xml, AValueWithoutQuotes) {
  const Element read =
      parse_xml("<a>\n<!-- x=y --><b name=blade1_v kind='c=d'/><b n=2>k=l</b></a>", "f");
  ASSERT_EQ(read.children.size(), 2U);
  EXPECT_EQ(*read.children[0].attribute("name"), "blade1_v");
  EXPECT_EQ(*read.children[0].attribute("kind"), "c=d");
  EXPECT_EQ(read.children[0].source.line, 2);
  EXPECT_EQ(*read.children[1].attribute("n"), "2");
  EXPECT_EQ(read.children[1].text, "k=l");
  const std::string usual = "<a b='c=d' e = \"f\"><!-- g=h --><![CDATA[<i j=k>]]></a>";
  EXPECT_EQ(with_quotes(usual), usual);
  for (const std::string cut : {"<a b=", "<a b='", "<a b=c", "<a b=c b=d/>", "<a =c/>"}) {
    EXPECT_THROW(parse_xml(cut, "f"), Error) << cut;
  }
}

}  // namespace
}  // namespace angen::load

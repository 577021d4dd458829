#include <sys/stat.h>

#include "angen_sim/load/texts.h"

namespace angen::load {
namespace {

/// A broken world and what must be said of it; the place is part of the text.
struct Broken {
  const char* name;
  const char* text;
  const char* place;
  const char* says;
};

void PrintTo(const Broken& broken, std::ostream* out) { *out << broken.name; }

const Broken kBroken[] = {
    {"empty", "", "w.world:1: ", "empty"},
    {"not_sdf", "<html>\n</html>", "w.world:1: ", "it must begin with <sdf>"},
    {"no_version", "<sdf>\n</sdf>", "w.world:1: ", "no version"},
    {"old_version", "<sdf version='1.2'/>", "w.world:1: ", "versions 1.4 to 1.9"},
    {"future_version", "<sdf version='1.99'/>", "w.world:1: ", "versions 1.4 to 1.9"},
    {"no_world", "<sdf version='1.6'>\n</sdf>", "w.world:1: ", "no <world>"},
    {"two_worlds", "<sdf version='1.6'>\n<world name='a'/>\n<world name='b'/></sdf>",
     "w.world:3: ", "second <world>"},
    {"truncated", "<sdf version='1.6'>\n<world name='w'>\n<model name='m'>\n<link na",
     "w.world:4: ", "cut off"},
    {"unclosed", "<sdf version='1.6'>\n<world name='w'>\n<model name='m'>\n</world></sdf>",
     "w.world:3: ", "not closed"},
    {"two_roots", "<sdf version='1.6'/>\n<sdf version='1.6'/>", "w.world:2: ", "second root"},
    {"double_attribute", "<sdf version='1.6'>\n<world name='a' name='b'/></sdf>",
     "w.world:2: ", "given twice"},
    {"not_utf8", "<sdf version='1.6'>\n<world name='\xff'/></sdf>", "w.world:2: ", "UTF-8"},
    {"nameless_world", "<sdf version='1.6'>\n<world/></sdf>", "w.world:2: ", "no name"},
    {"twin_models",
     "<sdf version='1.6'><world name='w'>\n<model name='m'><link name='l'/></model>\n"
     "<model name='m'><link name='l'/></model></world></sdf>",
     "w.world:3: ", "a model named 'm' stands already at line 2"},
    {"twin_links",
     "<sdf version='1.6'><world name='w'><model name='m'>\n<link name='l'/>\n<link name='l'/>"
     "</model></world></sdf>",
     "w.world:3: ", "the name 'l' is given twice"},
    {"link_and_joint",
     "<sdf version='1.6'><world name='w'><model name='m'>\n<link name='l'/><link name='k'/>\n"
     "<joint name='l' "
     "type='fixed'><parent>l</parent><child>k</child></joint></model></world></sdf>",
     "w.world:3: ", "the name 'l' is given twice"},
    {"twin_collisions",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'>\n"
     "<collision name='c'><geometry><empty/></geometry></collision>\n"
     "<collision name='c'><geometry><empty/></geometry></collision></link></model></world></sdf>",
     "w.world:3: ", "the name 'c' is given twice"},
    {"no_links", "<sdf version='1.6'><world name='w'>\n<model name='m'/></world></sdf>",
     "w.world:2: ", "no <link>"},
    {"reserved_name",
     "<sdf version='1.6'><world name='w'>\n<model name='__m__'><link name='l'/></model>"
     "</world></sdf>",
     "w.world:2: ", "reserved"},
    {"colons_in_name",
     "<sdf version='1.6'><world name='w'><model name='m'>\n<link "
     "name='a::b'/></model></world></sdf>",
     "w.world:2: ", "'::'"},
    {"bad_pose",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'>\n<pose>0 0 x 0 0 0</pose>"
     "</link></model></world></sdf>",
     "w.world:2: ", "'x', which is not a number"},
    {"short_pose",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'>\n<pose>0 0 0 0</pose>"
     "</link></model></world></sdf>",
     "w.world:2: ", "holds 4 numbers; give 6"},
    {"infinite_pose",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'>\n"
     "<pose>inf 0 0 0 0 0</pose></link></model></world></sdf>",
     "w.world:2: ", "not finite"},
    {"bad_step",
     "<sdf version='1.6'><world name='w'><physics type='ode'>\n<max_step_size>fast</max_step_size>"
     "</physics></world></sdf>",
     "w.world:2: ", "'fast', which is not a number"},
    {"zero_step",
     "<sdf version='1.6'><world name='w'><physics type='ode'>\n<max_step_size>0</max_step_size>"
     "</physics></world></sdf>",
     "w.world:2: ", "greater than 0"},
    {"bad_flag",
     "<sdf version='1.6'><world name='w'><model name='m'>\n<static>maybe</static><link name='l'/>"
     "</model></world></sdf>",
     "w.world:2: ", "give true or false"},
    {"negative_box",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'><collision name='c'>"
     "<geometry><box>\n<size>1 -1 "
     "1</size></box></geometry></collision></link></model></world></sdf>",
     "w.world:2: ", "<size> is -1; it must be greater than 0"},
    {"no_size",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'><collision name='c'>"
     "<geometry>\n<box/></geometry></collision></link></model></world></sdf>",
     "w.world:2: ", "<box> has no <size>"},
    {"unknown_shape",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'><visual name='c'>"
     "<geometry>\n<ellipsoid><radii>1 1 1</radii></ellipsoid></geometry></visual></link></model>"
     "</world></sdf>",
     "w.world:2: ", "unknown shape <ellipsoid>; known shapes are box"},
    {"no_geometry",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'>\n<visual name='c'/>"
     "</link></model></world></sdf>",
     "w.world:2: ", "no <geometry>"},
    {"no_mass",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'><inertial>\n<mass>0</mass>"
     "</inertial></link></model></world></sdf>",
     "w.world:2: ", "the mass is 0 kg"},
    {"impossible_inertia",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'><inertial><mass>1</mass>\n"
     "<inertia><ixx>1</ixx><iyy>1</iyy><izz>9</izz></inertia></inertial></link></model></world>"
     "</sdf>",
     "w.world:2: ", "must not exceed the sum"},
    {"unknown_link",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='a'/><link name='b'/>"
     "<joint name='j' type='fixed'>\n<parent>a</parent>\n<child>c</child></joint></model></world>"
     "</sdf>",
     "w.world:3: ", "unknown link 'c'; known are a, b, j"},
    {"unknown_joint_type",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='a'/><link name='b'/>\n"
     "<joint name='j' type='gearbox'><parent>a</parent><child>b</child></joint></model></world>"
     "</sdf>",
     "w.world:2: ", "unknown joint type 'gearbox'; known are ball, continuous, fixed"},
    {"joined_to_itself",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='a'/><link name='b'/>\n"
     "<joint name='j' "
     "type='fixed'><parent>a</parent><child>a</child></joint></model></world></sdf>",
     "w.world:2: ", "joins 'a' to itself"},
    {"zero_prismatic_axis",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='a'/><link name='b'/>"
     "<joint name='j' type='prismatic'><parent>a</parent><child>b</child>\n<axis><xyz>0 0 0</xyz>"
     "</axis></joint></model></world></sdf>",
     "w.world:2: ", "has length 0"},
    {"limits_swapped",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='a'/><link name='b'/>"
     "<joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz>\n"
     "<limit><lower>1</lower><upper>-1</upper></limit></axis></joint></model></world></sdf>",
     "w.world:2: ", "wrong way round"},
    {"pose_relative_to_nothing",
     "<sdf version='1.7'><world name='w'><model name='m'>\n<link name='a'>"
     "<pose relative_to='zz'>0 0 0 0 0 0</pose></link></model></world></sdf>",
     "w.world:2: ", "zz"},
    {"plugin_without_file", "<sdf version='1.6'><world name='w'>\n<plugin name='p'/></world></sdf>",
     "w.world:2: ", "no filename"},
    {"sensor_without_type",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'>\n<sensor name='s'/></link>"
     "</model></world></sdf>",
     "w.world:2: ", "no type"},
    {"unknown_light",
     "<sdf version='1.6'><world name='w'>\n<light name='l' type='laser'/></world></sdf>",
     "w.world:2: ", "unknown light type 'laser'"},
    {"include_without_uri", "<sdf version='1.6'><world name='w'>\n<include/></world></sdf>",
     "w.world:2: ", "no <uri>"},
    {"unknown_scheme",
     "<sdf version='1.6'><world name='w'><include>\n<uri>http://x/y</uri></include></world></sdf>",
     "w.world:2: ", "unknown uri 'http://x/y'"},
    {"missing_model",
     "<sdf version='1.6'><world name='w'><include>\n<uri>model://nowhere</uri></include></world>"
     "</sdf>",
     "w.world:2: ", "model 'model://nowhere' is not found; searched: "},
    {"missing_mesh",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'><visual name='v'><geometry>"
     "<mesh>\n<uri>model://m/meshes/x.dae</uri></mesh></geometry></visual></link></model></world>"
     "</sdf>",
     "w.world:2: ", "mesh 'model://m/meshes/x.dae' is not found; searched: "},
    {"state_of_nobody",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'/></model><state>\n"
     "<model name='n'/></state></world></sdf>",
     "w.world:2: ", "unknown model 'n'; known are m"},
    {"state_of_no_joint",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'/></model><state>"
     "<model name='m'>\n<joint name='j'><angle axis='0'>1</angle></joint></model></state></world>"
     "</sdf>",
     "w.world:2: ", "unknown joint 'j' of model 'm'"},
    {"colder_than_cold",
     "<sdf version='1.6'><world name='w'><model name='m'><link name='l'><visual name='v'><geometry>"
     "<sphere><radius>1</radius></sphere></geometry><plugin name='p' "
     "filename='gz-sim-thermal-system'>\n<temperature>-3</temperature></plugin></visual></link>"
     "</model></world></sdf>",
     "w.world:2: ", "<temperature> is -3 K; it must be greater than 0"},
    {"a_cold_world",
     "<sdf version='1.6'><world name='w'><atmosphere "
     "type='adiabatic'>\n<temperature>0</temperature>"
     "</atmosphere></world></sdf>",
     "w.world:2: ", "it must be greater than 0"},
    {"waypoints_back_in_time",
     "<sdf version='1.6'><world name='w'><actor name='a'><script><trajectory id='0' type='walk'>"
     "<waypoint><time>2</time><pose>0 0 0 0 0 0</pose></waypoint>\n<waypoint><time>1</time>"
     "<pose>0 0 0 0 0 0</pose></waypoint></trajectory></script></actor></world></sdf>",
     "w.world:2: ", "is not after the one before"},
};

class BrokenWorld : public testing::TestWithParam<Broken> {};

TEST_P(BrokenWorld, IsAnErrorWithItsPlace) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const std::string message = error_of(GetParam().text);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(message.find(GetParam().place), 0U) << message;
  EXPECT_NE(message.find(GetParam().says), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(All, BrokenWorld, testing::ValuesIn(kBroken),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(BrokenName, IsRefusedWhereverItStands) {
  const Folder folder;
  folder.model("part", sdf("<model name='p'><link name='l'/></model>"));
  const std::string include = "<include><uri>model://part</uri>";
  for (const std::string& text :
       {in_world("<model name='a/b'><link name='l'/></model>"), in_model("<link name='a/b'/>"),
        in_link("<sensor name='a/b' type='ray'/>"), in_link("<visual name=' v'/>"),
        in_world("<light name='a/b' type='point'/>"), in_world("<actor name='a/b'/>"),
        in_world(include + "<name>a/b</name></include>"),
        in_model("<link name='l'/>" + include + "<name>a/b</name></include>"),
        in_world(include + "<name>" + std::string(256, 'n') + "</name></include>")}) {
    const std::string message = error_of(text, folder.paths());
    EXPECT_EQ(message.find("w.world:1: "), 0U) << message;
    EXPECT_NE(message.find(": the name '"), std::string::npos) << message;
  }
}

TEST(BrokenInclude, WithTwoNamesIsRefused) {
  const Folder folder;
  folder.model("part", sdf("<model name='p'><link name='l'/></model>"));
  for (const std::string twice : {"name", "uri", "pose", "static"}) {
    std::string text = "<include><uri>model://part</uri>";
    if (twice != "uri") text += "<" + twice + ">1</" + twice + ">";
    text += "\n<" + twice + ">0</" + twice + "></include>";
    const std::string message = error_of(in_world(text), folder.paths());
    EXPECT_EQ(message.find("w.world:2: a second <" + twice + "> in one <include>"), 0U) << message;
  }
}

const char* const kInclude = "<include><uri>model://part</uri></include>";

TEST(BrokenInclude, NamesTheIncludedFile) {
  const Folder folder;
  const std::string file = folder.model(
      "part", sdf("<model name='m'><link name='l'><inertial>\n<mass>-2</mass></inertial></link>"
                  "</model>"));
  const std::string message = error_of(in_world(kInclude), folder.paths());
  EXPECT_EQ(message.find(file + ":2: "), 0U) << message;
  EXPECT_NE(message.find("the mass is -2 kg"), std::string::npos) << message;
}

TEST(BrokenInclude, TruncatedFileIsNamed) {
  const Folder folder;
  const std::string file = folder.model("part", "<sdf version='1.6'>\n<model name='m'>\n<link");
  const std::string message = error_of(in_world(kInclude), folder.paths());
  EXPECT_EQ(message.find(file + ":3: "), 0U) << message;
}

TEST(BrokenInclude, CycleEndsWithItsPlace) {
  const Folder folder;
  const std::string other = folder.model(
      "other", sdf("<model name='o'><link name='l'/>\n<include><uri>model://part</uri></include>"
                   "</model>"));
  folder.model("part",
               sdf("<model name='m'><link name='l'/><include><uri>model://other</uri></include>"
                   "</model>"));
  const std::string message = error_of(in_world(kInclude), folder.paths());
  EXPECT_EQ(message.find(other + ":2: "), 0U) << message;
  EXPECT_NE(message.find("cycle of includes"), std::string::npos) << message;
}

TEST(BrokenInclude, DepthIsBounded) {
  const Folder folder;
  for (int i = 0; i < 20; ++i) {
    folder.model("part" + (i == 0 ? "" : std::to_string(i)),
                 sdf("<model name='m" + std::to_string(i) +
                     "'><link name='l'/><include><uri>"
                     "model://part" +
                     std::to_string(i + 1) + "</uri></include></model>"));
  }
  EXPECT_NE(error_of(in_world(kInclude), folder.paths()).find("more than 16 deep"),
            std::string::npos);
}

TEST(BrokenInclude, DoublingIsBounded) {
  const Folder folder;
  std::string filler;
  for (int i = 0; i < 100; ++i) filler += "<frame name='f" + std::to_string(i) + "'/>";
  for (int i = 0; i < 14; ++i) {
    const std::string next = "model://part" + std::to_string(i + 1);
    folder.model(
        "part" + (i == 0 ? "" : std::to_string(i)),
        sdf("<model name='m'><link name='l'/>" + filler + "<include><name>a</name><uri>" + next +
            "</uri></include><include><name>b</name><uri>" + next + "</uri></include></model>"));
  }
  folder.model("part14", sdf("<model name='m'><link name='l'/>" + filler + "</model>"));
  EXPECT_NE(error_of(in_world(kInclude), folder.paths()).find("more than 400000 elements"),
            std::string::npos);
}

TEST(BrokenInclude, FileWithoutAModel) {
  const Folder folder;
  const std::string file = folder.model("part", sdf("<world name='w'/>"));
  EXPECT_EQ(error_of(in_world(kInclude), folder.paths()).find(file + ":1: "), 0U);
}

TEST(BrokenInclude, ConfigThatNamesNoFile) {
  const Folder folder;
  const std::string file =
      folder.write("part/model.config", "<model>\n<sdf version='1.6'>nothing.sdf</sdf></model>");
  const std::string message = error_of(in_world(kInclude), folder.paths());
  EXPECT_EQ(message.find(file + ":2: "), 0U) << message;
}

TEST(BrokenMesh, DamagedFileIsNamedWhereItIsUsed) {
  const Folder folder;
  folder.write("part/x.stl", "solid nothing");
  const std::string message =
      error_of(in_link("<visual name='v'><geometry><mesh>\n<uri>model://part/x.stl</uri></mesh>"
                       "</geometry></visual>"),
               folder.paths());
  EXPECT_EQ(message.find("w.world:2: mesh "), 0U) << message;
}

// Cut anywhere, a world is an error and never more than that.
TEST(Truncation, IsAlwaysAnError) {
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

TEST(TooMuch, ElementsAreBounded) {
  std::string many;
  for (int i = 0; i < 100'001; ++i) many += "<x/>";
  EXPECT_NE(error_of(in_world(many)).find("more than 100000 elements"), std::string::npos);
}

TEST(TooMuch, DepthIsBounded) {
  std::string deep;
  for (int i = 0; i < 5000; ++i) deep += "<model name='m'>";
  EXPECT_NE(error_of("<sdf version='1.6'>" + deep).find("w.world:1: "), std::string::npos);
}

TEST(MissingFile, FolderOrPipeIsNotRead) {
  const Folder folder;
  const std::string pipe = folder.path() + "/pipe.world";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(world(pipe), Error);
  EXPECT_THROW(world(folder.path()), Error);
  const std::string mesh =
      "<visual name='v'><geometry><mesh><uri>model://pipe.world</uri></mesh></geometry></visual>";
  EXPECT_NE(error_of(in_link(mesh), folder.paths()).find("is not a file"), std::string::npos);
}

TEST(MissingFile, IsNamed) { EXPECT_THROW(world("/nonexistent/x.world"), Error); }

}  // namespace
}  // namespace angen::load
